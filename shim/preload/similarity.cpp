#include "shim/preload/similarity.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace glcast::preload {

bool is_similarity(const glm::dmat4& matrix, double tolerance) {
    const glm::dmat3 m(matrix);
    const double scale = std::cbrt(glm::determinant(m));
    if (!(scale > 0) || !std::isfinite(scale)) return false;
    const glm::dmat3 gram = glm::transpose(m) * m / (scale * scale);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (std::abs(gram[i][j] - (i == j)) > tolerance) return false;
    const double weights[] = {matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3] - 1};
    for (const double weight : weights)
        if (std::abs(weight) > tolerance) return false;
    return true;
}

} // namespace glcast::preload
