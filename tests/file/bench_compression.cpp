// Processor time and size of the compressions that OpenEXR offers, on the six views of a sphere: the table in
// docs/reference/capture-format.md. Usage: bench_compression [N]
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "capture/exr_compress.h"
#include "tests/file/sphere_capture.h"

using namespace glcast;

namespace {

std::vector<std::vector<float>> planes_of(const ViewImage& image) {
    std::vector<std::vector<float>> planes(9);
    for (std::size_t p = 0; p < image.depth.size(); ++p) {
        const glm::vec4 c = image.colour[p], n = image.normal[p];
        using exr::without_noise;
        const float values[] = {
            c.a, c.b,           c.g, n.w, without_noise(n.x), without_noise(n.y), without_noise(n.z),
            c.r, image.depth[p]};
        for (int k = 0; k < 9; ++k) planes[k].push_back(values[k]);
    }
    return planes;
}

struct Result {
    double seconds = 0;
    std::size_t bytes = 0;
};

Result measure(const std::vector<std::vector<std::vector<float>>>& views, int n,
               exr::Compression compression) {
    const std::vector<exr::Channel> channels = {{"A", true},    {"B", true},    {"G", true},
                                                {"N.V", true},  {"N.X", false}, {"N.Y", false},
                                                {"N.Z", false}, {"R", true},    {"Z", false}};
    Result result;
    const std::clock_t start =
        std::clock(); // processor time: the table should not depend on who else is busy
    for (const auto& planes : views)
        for (int line = 0; line < n; line += exr::band_lines) {
            const int lines = std::min(exr::band_lines, n - line);
            std::vector<std::vector<float>> band;
            for (const auto& plane : planes)
                band.emplace_back(plane.begin() + long(line) * n, plane.begin() + long(line + lines) * n);
            std::vector<exr::Chunk> chunks;
            std::string error;
            if (!exr::compress_band(channels, band, n, lines, line, compression, chunks, error)) std::abort();
            for (const exr::Chunk& chunk : chunks) result.bytes += chunk.bytes.size() + 12;
        }
    result.seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    return result;
}

} // namespace

int main(int argc, char** argv) {
    const int n = argc > 1 ? std::atoi(argv[1]) : 512;
    std::vector<std::vector<std::vector<float>>> views;
    for (const View& view : samples::six_views())
        views.push_back(planes_of(samples::sphere_view(n, view.axis, view.side)));
    const std::pair<const char*, exr::Compression> table[] = {{"none", exr::Compression::none},
                                                              {"RLE", exr::Compression::rle},
                                                              {"ZIPS", exr::Compression::zips},
                                                              {"ZIP", exr::Compression::zip},
                                                              {"PIZ", exr::Compression::piz}};
    std::printf("six views of a sphere, n = %d\n", n);
    for (const auto& [name, compression] : table) {
        const Result result = measure(views, n, compression);
        std::printf("%-5s %8.1f ms %9.3f MB\n", name, result.seconds * 1e3, double(result.bytes) / 1e6);
    }
}
