// mesh-oracle FILE...: exit 0 when every file holds a closed two-manifold, 1 when one does not, 2 without a
// file.
#include <cstdio>

#include "tests/mesh/independent_check/oracle.h"

int main(int count, char** arguments) {
    if (count < 2) {
        std::fprintf(stderr, "usage: mesh-oracle FILE...   (.obj, .off, .ply)\n");
        return 2;
    }
    bool all_good = true;
    for (int i = 1; i < count; ++i) {
        const glcast::test::OracleOpinion opinion =
            glcast::test::ask_oracle(std::filesystem::path(arguments[i]));
        const bool good = opinion.fault.empty();
        std::printf("%s: %s, %zu vertices, %zu edges, %zu triangles\n", arguments[i],
                    good ? "closed two-manifold" : ("NOT a closed two-manifold: " + opinion.fault).c_str(),
                    opinion.vertices, opinion.edges, opinion.triangles);
        all_good = all_good && good;
    }
    return all_good ? 0 : 1;
}
