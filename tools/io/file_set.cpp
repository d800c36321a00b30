#include <stdexcept>

#include "tools/io/mesh_format.h"
#include "tools/picture/png.h"

namespace glcast::format {

OutputFile& FileSet::open(const std::filesystem::path& path, std::vector<std::filesystem::path>& list) {
    return files.emplace_back(list.emplace_back(path).string());
}

std::vector<std::filesystem::path> FileSet::commit() {
    std::vector<OutputFile*> all;
    for (OutputFile& file : files) {
        if (!file.error().empty()) throw std::runtime_error(file.error());
        all.push_back(&file);
    }
    if (const OutputFile* failed = OutputFile::commit_all(all)) throw std::runtime_error(failed->error());
    std::vector<std::filesystem::path> names = meshes;
    names.insert(names.end(), companions.begin(), companions.end());
    return names;
}

bool write_pictures(FileSet& files, const std::filesystem::path& path, const Texture& texture,
                    bool with_normal, PictureNames& names) {
    const auto write = [&](const char* what, const Picture& picture, std::string& name) {
        name = path.stem().string() + what + ".png";
        const std::string bytes = png_bytes(picture);
        return files.companion(path.parent_path() / name).append(bytes.data(), bytes.size());
    };
    return write(".colour", texture.colour, names.colour) &&
           (!with_normal || write(".normal", texture.normal, names.normal));
}

} // namespace glcast::format
