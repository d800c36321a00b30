// Conjugate gradients (Hestenes and Stiefel 1952), in one order: the same bits on any number of threads. Internal.
#pragma once
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace glcast {

using Vectors = std::vector<glm::dvec3>;

inline double dot(const Vectors& a, const Vectors& b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += glm::dot(a[v], b[v]);
    return sum;
}

/// Solves times(x) = right, where `times` is linear, symmetric and positive definite.
template <class Times> Vectors conjugate_gradients(const Vectors& right, const Times& times) {
    constexpr int most_steps = 60;
    constexpr double enough = 1e-8; // of the squared gradient
    Vectors x(right.size(), glm::dvec3(0)), rest = right, search = rest;
    double now = dot(rest, rest);
    const double last = enough * now;
    for (int step = 0; step < most_steps && now > last; ++step) {
        const Vectors image = times(search);
        const double length = now / dot(search, image);
        for (std::size_t v = 0; v < x.size(); ++v) {
            x[v] += length * search[v];
            rest[v] -= length * image[v];
        }
        const double next = dot(rest, rest);
        for (std::size_t v = 0; v < x.size(); ++v) search[v] = rest[v] + next / now * search[v];
        now = next;
    }
    return x;
}

} // namespace glcast
