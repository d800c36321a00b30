// Layers without fragment shaders: near and far clip planes, a slab of the box at a time, as Natvig 2006,
// section 3, has it.
#pragma once
#include "capture/engine_layers.h"

namespace glcast {

/// The box is cut across the axis until no pixel of a slab has more than two fragments (counted in the
/// stencil buffer): then the first and the last of each slab are all there is. The paper's remedies: every
/// slab is drawn a little larger than it is, so that nothing falls between two clip planes, and what two
/// slabs saw is told apart by its depth. Hits are collected before layers are made of them, at most as much
/// as two images hold; where that, or the number of slabs, or their thinness does not suffice, the layers are
/// not complete.
AxisLayers slab_axis(const LayerTask& task, const OuterHits& hits, const LayerSink& sink);

} // namespace glcast
