// Evaluator maps: control points are packed tightly, so the strides of a packet are the number of components.
#include <vector>

#include "shim/record/packets.h"

namespace glcast::record {

namespace {

/// Whether GL takes the map; if not, the call changes nothing and its points must not be read.
bool is_order(Context& context, GLint order) {
    return order >= 1 && context.can_query() && order <= get_int(context.real, GL_MAX_EVAL_ORDER, 8);
}

template <class T>
std::vector<T> gather(const T* points, std::size_t n, GLint ustride, GLint uorder, GLint vstride,
                      GLint vorder) {
    std::vector<T> packed;
    packed.reserve(n * std::size_t(uorder) * std::size_t(vorder));
    for (GLint u = 0; u < uorder; ++u)
        for (GLint v = 0; v < vorder; ++v) {
            const T* point = points + std::ptrdiff_t(u) * ustride + std::ptrdiff_t(v) * vstride;
            packed.insert(packed.end(), point, point + n);
        }
    return packed;
}

template <class Packet, class T>
void record_map1(GLenum target, T u1, T u2, GLint stride, GLint order, const T* points) {
    Context* context = listening_context();
    const auto n = sizes::map_components(target);
    if (!context || n == 0 || stride < GLint(n) || !is_order(*context, order) || !points) return;
    context->emit(true, [&](Stream& stream) {
        Packet::write(stream, target, u1, u2, GLint(n), order, gather(points, n, stride, order, 0, 1).data());
    });
}

template <class Packet, class T>
void record_map2(GLenum target, T u1, T u2, GLint ustride, GLint uorder, T v1, T v2, GLint vstride,
                 GLint vorder, const T* points) {
    Context* context = listening_context();
    const auto n = GLint(sizes::map_components(target));
    if (!context || n == 0 || ustride < n || vstride < n || !points) return;
    if (!is_order(*context, uorder) || !is_order(*context, vorder)) return;
    context->emit(true, [&](Stream& stream) {
        Packet::write(stream, target, u1, u2, n * vorder, uorder, v1, v2, n, vorder,
                      gather(points, std::size_t(n), ustride, uorder, vstride, vorder).data());
    });
}

} // namespace
} // namespace glcast::record

namespace glcast::record::custom {

void APIENTRY Map1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points) {
    record_map1<packets::Map1f>(target, u1, u2, stride, order, points);
    this_thread.real->Map1f(target, u1, u2, stride, order, points);
}

void APIENTRY Map1d(GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order,
                    const GLdouble* points) {
    record_map1<packets::Map1d>(target, u1, u2, stride, order, points);
    this_thread.real->Map1d(target, u1, u2, stride, order, points);
}

void APIENTRY Map2f(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1,
                    GLfloat v2, GLint vstride, GLint vorder, const GLfloat* points) {
    record_map2<packets::Map2f>(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    this_thread.real->Map2f(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
}

void APIENTRY Map2d(GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1,
                    GLdouble v2, GLint vstride, GLint vorder, const GLdouble* points) {
    record_map2<packets::Map2d>(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
    this_thread.real->Map2d(target, u1, u2, ustride, uorder, v1, v2, vstride, vorder, points);
}

} // namespace glcast::record::custom
