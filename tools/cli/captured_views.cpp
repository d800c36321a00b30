#include "tools/cli/captured_views.h"

#include "tools/cli/command.h"
#include "tools/io/capture_reader.h"

namespace glcast::cli {

CapturedSix read_six_views(const std::string& file) {
    const Progress progress("reading " + file);
    CapturedSix captured;
    captured.info = read_capture(file, [&](ViewImage&& image) {
        if (image.view.layer == 0) captured.views.push_back(std::move(image));
    });
    return captured;
}

} // namespace glcast::cli
