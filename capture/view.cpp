#include "capture/view.h"

namespace glcast {

glm::dmat4 lattice_projection(const Box& box, Axis axis) {
    const ImageAxes axes = image_axes(axis);
    const int rows[] = {axes.u, axes.v, axes.depth};
    glm::dmat4 projection(0.0); // a permutation, scaled: clip row r reads axis rows[r]
    for (int r = 0; r < 3; ++r) {
        projection[rows[r]][r] = 2.0 / box.size;
        projection[3][r] = -2.0 * box.lo[rows[r]] / box.size - 1.0;
    }
    projection[3][3] = 1.0;
    return projection;
}

glm::dmat4 lattice_slab_projection(const Box& box, Axis axis, double near, double far) {
    glm::dmat4 slab(1.0); // clip depth -1..1 of the box: those of near and far become -1 and 1
    slab[2][2] = 1 / (far - near);
    slab[3][2] = (1 - near - far) / (far - near);
    return slab * lattice_projection(box, axis);
}

glm::dvec3 lattice_point(const Box& box, int n, Axis axis, int i, int j, double depth) {
    const ImageAxes axes = image_axes(axis);
    glm::dvec3 point = box.lo;
    point[axes.u] += (i + 0.5) / n * box.size;
    point[axes.v] += (j + 0.5) / n * box.size;
    point[axes.depth] += depth * box.size;
    return point;
}

} // namespace glcast
