// bench-progressive MESH: what a progressive mesh of it costs. Processor time of all threads.
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "tools/io/mesh_io.h"
#include "tools/progressive/geomorph.h"
#include "tools/progressive/openmesh_pm.h"
#include "tools/progressive/stream.h"
#include "tools/simplify/simplify.h"

using namespace glcast;

namespace {

double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

template <class Do> double seconds(Do&& act) {
    const double before = processor_seconds();
    act();
    return processor_seconds() - before;
}

void print(const char* what, double time, std::size_t splits) {
    std::printf("%-34s %8.3f s %8.2f M splits/s\n", what, time, double(splits) / time / 1e6);
}

template <class Write> std::size_t bytes_of(const std::filesystem::path& path, double& time, Write&& write) {
    time = seconds([&] {
        OutputFile file(path.string());
        write(file);
        if (!file.commit()) throw std::runtime_error(file.error());
    });
    const std::size_t bytes = std::filesystem::file_size(path);
    return bytes;
}

void measure(const Mesh& mesh) {
    CollapseLog log;
    const SimplifyTarget coarsest{SimplifyTarget::Unit::triangles, 500};
    const double simplified = seconds([&] { simplify_levels(mesh, {&coarsest, 1}, {.refit = false}, &log); });
    const double vertices = double(mesh.positions.size());
    std::printf("%zu vertices, %zu triangles, %zu splits; normals %s, colours %s\n", mesh.positions.size(),
                mesh.triangles.size(), log.size(), mesh.normals.empty() ? "no" : "yes",
                mesh.colours.empty() ? "no" : "yes");
    print("simplify to 500 triangles", simplified, log.size());
    std::unique_ptr<ProgressiveMesh> pm;
    print("from log", seconds([&] { pm = std::make_unique<ProgressiveMesh>(mesh, log); }), log.size());
    print("refine, forward", seconds([&] { pm->refine_to(pm->splits()); }), log.size());
    print("refine, back", seconds([&] { pm->refine_to(0); }), log.size());
    pm->refine_to(pm->splits());
    print("mesh() of all", seconds([&] { pm->mesh(); }), log.size());
    const auto folder = std::filesystem::temp_directory_path();
    double time = 0;
    const auto stream = folder / "bench-progressive.glpm", openmesh = folder / "bench-progressive.pm";
    std::size_t bytes = bytes_of(stream, time, [&](OutputFile& file) { write_progressive(file, *pm, {}); });
    print("write .glpm", time, log.size());
    print("read .glpm",
          seconds([&] { pm = std::make_unique<ProgressiveMesh>(read_progressive(stream).mesh); }),
          log.size());
    std::printf("%-34s %8.1f bytes a vertex\n", ".glpm", double(bytes) / vertices);
    std::printf("%-34s %8.1f bytes a vertex\n", "memory", double(pm->bytes()) / vertices);
    bytes = bytes_of(openmesh, time, [&](OutputFile& file) { write_openmesh_pm(file, *pm); });
    print("write .pm", time, log.size());
    std::printf("%-34s %8.1f bytes a vertex\n", ".pm", double(bytes) / vertices);
    std::filesystem::remove(stream), std::filesystem::remove(openmesh);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fputs("bench-progressive MESH\n", stderr), 2;
    try {
        measure(read_mesh(argv[1]));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bench-progressive: %s\n", e.what());
        return 1;
    }
}
