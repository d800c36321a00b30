#include "tools/cli/progressive.h"

#include <cstdio>

#include "tools/progressive/stream.h"
#include "tools/words/text.h"

namespace glcast::cli {
namespace {

using Json = nlohmann::ordered_json;

Json counts(const ProgressiveMesh& mesh, std::size_t level) {
    return {{"vertices", mesh.vertices(level)},
            {"edges", mesh.edges(level)},
            {"triangles", mesh.triangles(level)}};
}

} // namespace

int progressive_info(const std::filesystem::path& path, bool json) {
    ProgressiveFile file = read_progressive(path);
    const ProgressiveMesh& mesh = file.mesh;
    const MeshCheck check = check_mesh(mesh.mesh(), CheckDepth::everything);
    const auto bytes = std::filesystem::file_size(path);
    if (json) {
        Json finest = counts(mesh, mesh.splits());
        finest["check"] = to_json(check);
        Json object = {{"file", path.string()},
                       {"kind", "progressive mesh"},
                       {"bytes", bytes},
                       {"name", file.info.name},
                       {"complete", file.complete},
                       {"blocks", file.blocks},
                       {"splits", mesh.splits()},
                       {"splitsWhenComplete", file.info.splits()},
                       {"base", counts(mesh, 0)},
                       {"finest", finest}};
        object["hasNormals"] = mesh.has_normals(), object["hasColours"] = mesh.has_colours();
        if (file.info.sample > 0) object["sample"] = file.info.sample;
        print_json(object);
        return 0;
    }
    std::printf("progressive mesh  %s, %ju bytes, %s\n", printable(path.string()).c_str(), std::uintmax_t(bytes),
                file.complete ? "complete" : "cut off");
    std::printf("  name \"%s\"%s%s, %zu vertex splits in %zu blocks\n", printable(file.info.name).c_str(),
                mesh.has_normals() ? ", normals" : "", mesh.has_colours() ? ", colours" : "", mesh.splits(),
                file.blocks);
    std::printf("  base    %zu triangles, %zu edges\n", mesh.triangles(0), mesh.edges(0));
    std::printf("  finest  %s\n", summary(check).c_str());
    if (!file.complete)
        std::printf("  the original has %zu triangles; the rest of the file is missing\n",
                    file.info.triangles);
    return 0;
}

} // namespace glcast::cli
