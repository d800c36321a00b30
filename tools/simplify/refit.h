// A coarse mesh laid as well as it goes along the surface it came from. Internal.
// Method: the inner loop of Hoppe, DeRose, Duchamp, McDonald and Stuetzle 1993, "Mesh optimization", with
// swaps of edges, and no collapses.
#pragma once
#include "tools/simplify/area_points.h"
#include "tools/simplify/attributes.h"
#include "tools/simplify/collapser.h"
#include "tools/simplify/simplify.h"

namespace glcast {

/// Moves vertices and swaps edges of the remainder towards the least sum of squared distances from points
/// spread evenly over `surface`, and of its own points from it; `along` is a walk along that surface. Which
/// part of the remainder a point belongs to is found by walking along it, from the vertex that the point's
/// surroundings collapsed into, and only triangles that face as the point does count: the two sides of a thin
/// wall stay apart. No triangle turns over, the number of triangles and what is connected stay. A remainder
/// of more than some 30,000 triangles is left as it is: there the collapses do as well; of more than 10,000
/// with little work. Deterministic on any number of threads.
void refit(Collapser::Remainder& remainder, const SurfaceArea& surface, const SurfaceWalk& along,
           FitWork work = FitWork::full);

} // namespace glcast
