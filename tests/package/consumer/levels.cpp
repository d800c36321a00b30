// A capture file to two levels of detail in a .glb: levels CAPTURE.exr OUT.glb
#include <cstdio>
#include <exception>
#include <glcast/pipeline.h>

int main(int count, char** arguments) {
    if (count != 3) return 2;
    try {
        glcast::PipelineOptions how;
        how.targets = {{.value = 1000}, {.value = 200}}; // triangles
        const glcast::MeshedCapture made = glcast::mesh_capture(arguments[1], arguments[2], how);
        for (std::size_t k = 0; k < made.levels.size(); ++k)
            std::printf("%s: %zu triangles, 99.9 %% within %g samples\n", made.files[k].c_str(),
                        made.checks[k].triangles, made.levels[k].error.p999 / made.sample);
        return made.levels.size() == 2 && made.checks[1].triangles <= 200 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
