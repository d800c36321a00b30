#include "tools/cli/texture.h"

#include <bit>

namespace glcast::cli {
namespace {

double unseen_share(const TextureReport& report) {
    return report.texels ? double(report.texels_unseen) / double(report.texels) : 0;
}

} // namespace

CLI::Validator texture_size() {
    return CLI::Validator(
        [](std::string& text) -> std::string {
            if (text == "auto" || text == "none") return {};
            int size = 0;
            if (CLI::detail::lexical_cast(text, size) && size >= smallest_texture &&
                size <= largest_texture && std::has_single_bit(unsigned(size)))
                return {};
            return "a texture is auto, none, or has 64, 128, 256, ... or 8192 texels along an edge, not " + text;
        },
        "SIZE");
}

TextureChoice texture_choice(const std::string& text) {
    if (text == "auto") return {};
    if (text == "none") return {TextureChoice::Kind::none};
    return {TextureChoice::Kind::sized, std::stoi(text)};
}

nlohmann::ordered_json to_json(const TextureReport& report) {
    return {{"size", report.size},
            {"charts", report.charts},
            {"gutter", report.gutter},
            {"texelsPerSample", report.texels_per_sample},
            {"texels", report.texels},
            {"unseenShare", unseen_share(report)}};
}

std::string describe(const TextureReport& report) {
    const std::string edge = std::to_string(report.size);
    return "texture " + edge + " x " + edge + ": " + std::to_string(report.charts) + " charts, " +
           number(report.texels_per_sample) + " texels a sample, " + number(100 * unseen_share(report)) +
           " % of it seen by no ray";
}

} // namespace glcast::cli
