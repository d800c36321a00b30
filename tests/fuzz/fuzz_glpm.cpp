// Progressive meshes, damaged behind their checksums. All levels that come are walked.
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "tests/fuzz/input.h"
#include "tests/progressive/apart.h"
#include "tools/progressive/stream.h"

using namespace glcast;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
    fuzz::Dice dice(seed);
    if (dice() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
    try {
        test::Apart apart(std::string(reinterpret_cast<const char*>(data), size));
        if (apart.chunks.empty() || dice() % 8 == 0) {
            fuzz::mutate(apart.header, apart.header.size());
        } else {
            auto& chunk = apart.chunks[dice() % apart.chunks.size()];
            if (dice() % 8)
                fuzz::mutate(chunk.bytes, chunk.bytes.size() + dice() % 2);
            else
                chunk.count = dice() % 2 ? chunk.count + dice() % 3 - 1 : std::uint32_t(dice());
        }
        return fuzz::give(apart.together(), data, size, max_size);
    } catch (const std::exception&) {
        return LLVMFuzzerMutate(data, size, max_size);
    }
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::on_one_thread();
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    try {
        ProgressiveReader reader(in);
        do {
            ProgressiveMesh& mesh = reader.mesh();
            mesh.refine_to(0);
            mesh.refine_to(mesh.splits());
            const Mesh level = mesh.mesh();
            for (const Triangle& t : level.triangles)
                for (std::uint32_t v : t)
                    if (v >= level.positions.size()) std::abort();
        } while (reader.next());
    } catch (const std::runtime_error&) {
    }
    return 0;
}
