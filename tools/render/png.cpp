#include <stdexcept>

#include "capture/output_file.h"
#include "tools/picture/png.h"
#include "tools/render/render.h"

namespace glcast {

void write_png(const std::filesystem::path& path, const Picture& picture) {
    const std::string bytes = png_bytes(picture);
    OutputFile file(path.string());
    if (!file.append(bytes.data(), bytes.size()) || !file.commit()) throw std::runtime_error(file.error());
}

} // namespace glcast
