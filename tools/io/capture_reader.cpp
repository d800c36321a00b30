#include "tools/io/capture_reader.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <tbb/parallel_pipeline.h>
#include <utility>

#include "capture/exr_header.h"
#include "tools/io/capture_layout.h"
#include "tools/io/capture_pixels.h"

namespace glcast {
namespace {

constexpr std::size_t parts_in_memory = 2; // 36 bytes a pixel

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }

/// The part of each view: views[axis][0] is +a.0, views[axis][1 + k] is -a.k.
using PartIndex = std::array<std::vector<int>, 3>;

std::size_t slot_of(const View& view) { return view.side == Side::plus ? 0 : 1 + std::size_t(view.layer); }

PartIndex index_parts(const CaptureHeader& header) {
    PartIndex index;
    for (int axis = 0; axis < 3; ++axis)
        index[axis].assign(1 + std::size_t(header.info.layer_count[axis]), -1);
    for (int part = 0; part < int(header.parts.size()); ++part) {
        const View& view = header.parts[part].view;
        std::vector<int>& parts = index[static_cast<int>(view.axis)];
        const std::size_t slot = slot_of(view);
        if (slot >= parts.size() || (view.side == Side::plus && view.layer > 0))
            refuse("view " + part_name(view) + " is not among the layers of the header");
        if (parts[slot] >= 0) refuse("view " + part_name(view) + " is there twice");
        parts[slot] = part;
    }
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t slot = 0; slot < index[axis].size(); ++slot) {
            const View view = slot == 0 ? View{Axis(axis), Side::plus, 0}
                                        : View{Axis(axis), Side::minus, static_cast<int>(slot) - 1};
            if (index[axis][slot] < 0) refuse("view " + part_name(view) + " is missing");
        }
    return index;
}

/// The first hit of a pixel is not behind its last. Layers come in growing depth, strictly between these two,
/// none left out.
class LayerOrder {
  public:
    void check(const ViewImage& image) {
        if (image.view.layer > 0) return follow(image);
        std::vector<float>& depth = image.view.side == Side::minus ? previous : last;
        depth = image.depth;
        for (std::size_t p = 0; p < depth.size(); ++p)
            if (!image.covered(p)) depth[p] = image.view.side == Side::minus ? none : -none;
        if (image.view.side == Side::plus) compare(image);
    }

  private:
    static constexpr float none = 2;

    void compare(const ViewImage& plus) {
        for (std::size_t p = 0; p < last.size(); ++p)
            if (plus.covered(p) && previous[p] != none && previous[p] > last[p])
                refuse("part " + part_name(plus.view) + " has a last hit in front of the first");
    }

    void follow(const ViewImage& image) {
        for (std::size_t p = 0; p < previous.size(); ++p) {
            if (!image.covered(p))
                previous[p] = none;
            else if (image.depth[p] > previous[p] && image.depth[p] < last[p])
                previous[p] = image.depth[p];
            else
                refuse("part " + part_name(image.view) + " does not lie between the layers around it");
        }
    }

    std::vector<float> previous, last;
};

struct OpenCapture {
    InputFile file;
    CaptureHeader header;
    CaptureLayout layout;
    PartIndex parts;

    explicit OpenCapture(const std::filesystem::path& path)
        : file(path), header(read_capture_header(file)), layout(read_capture_layout(file, header)),
          parts(index_parts(header)) {}
};

/// A part on its way from the file to who wants it.
struct Moving {
    int part;
    bool first_of_axis;
    ViewImage image;
};

std::vector<Moving> in_order(const PartIndex& index) {
    std::vector<Moving> all;
    for (const std::vector<int>& parts : index)
        for (std::size_t k = 0; k < parts.size(); ++k)
            all.push_back({parts[k < 2 ? 1 - k : k], k == 0, {}}); // -a.0 before +a.0
    return all;
}

/// One part is unpacked while the one before it is handed on.
void read_parts(const OpenCapture& capture, const PartSink& sink) {
    std::vector<Moving> parts = in_order(capture.parts);
    LayerOrder order;
    std::size_t next = 0;
    tbb::parallel_pipeline(
        parts_in_memory,
        tbb::make_filter<void, Moving*>(tbb::filter_mode::serial_in_order,
                                        [&](tbb::flow_control& control) -> Moving* {
                                            if (next < parts.size()) return &parts[next++];
                                            control.stop();
                                            return nullptr;
                                        }) &
            tbb::make_filter<Moving*, Moving*>(tbb::filter_mode::parallel,
                                               [&](Moving* at) {
                                                   const std::size_t part = std::size_t(at->part);
                                                   at->image = read_part(capture.file, capture.header.info.n,
                                                                         capture.header.parts[part],
                                                                         capture.layout[part]);
                                                   at->image.reversed_backs =
                                                       capture.header.info.reversed_backs;
                                                   return at;
                                               }) &
            tbb::make_filter<Moving*, void>(tbb::filter_mode::serial_in_order, [&](Moving* at) {
                if (at->first_of_axis) order = {};
                order.check(at->image);
                sink(std::exchange(at->image, {}));
            }));
}

/// What a library says, on one line.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text;
}

template <class Read> auto with_file_name(const std::filesystem::path& path, Read&& read) {
    try {
        return read();
    } catch (const std::bad_alloc&) {
        throw; // no fault of the file
    } catch (const std::exception& e) {
        throw std::runtime_error("cannot read capture '" + path.string() + "': " + one_line(e.what()));
    }
}

} // namespace

CaptureInfo read_capture_info(const std::filesystem::path& path) {
    return with_file_name(path, [&] { return OpenCapture(path).header.info; });
}

CaptureInfo read_capture(const std::filesystem::path& path, const PartSink& sink) {
    return with_file_name(path, [&] {
        OpenCapture capture(path);
        read_parts(capture, sink);
        return capture.header.info;
    });
}

Capture read_capture(const std::filesystem::path& path) {
    return with_file_name(path, [&] {
        OpenCapture file(path);
        Capture capture;
        capture.info = file.header.info;
        capture.file_bytes = file.file.size();
        read_parts(file, [&](ViewImage&& image) { capture.images.push_back(std::move(image)); });
        return capture;
    });
}

bool looks_like_exr(const std::filesystem::path& path) {
    try {
        return exr::read_u32(InputFile(path).read(0, 4).data()) == exr::magic;
    } catch (const std::runtime_error&) {
        return false;
    }
}

} // namespace glcast
