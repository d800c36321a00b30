// The hits of an axis' rays between the first and the last, layer by layer.
#pragma once
#include <functional>
#include <vector>

#include "capture/engine_pass.h"
#include "capture/engine_peel.h"
#include "capture/engine_sides.h"

namespace glcast {

/// What an axis' layers are looked for with. `most`: parts of the axis, layer 0 counted, at least 2.
struct LayerTask {
    PassRunner& passes;
    const Target& target;
    Box box;
    Axis axis = Axis::x;
    NormalMethod normals = NormalMethod::signed_lights;
    int most = 2;
    SidesTask sides;
};

/// First and last hit of each ray of the axis, depths 0..1; first > last where there is none.
struct OuterHits {
    std::vector<float> first, last;
};

struct AxisLayers {
    int count = 1;        ///< layer 0 counted
    bool complete = true; ///< there is no hit beyond these
    bool stopped = false; ///< by the sink
    bool usable = true;   ///< false: nothing was found out, and nothing given to the sink
};

/// Takes the layers 1, 2, ... in order; false stops.
using LayerSink = std::function<bool(ViewImage&&)>;

/// A third hit fits between two of a ray of the n-lattice, depths 0..1.
bool has_room(float first, float last, int n);

/// The pixels whose rays have room for a hit between the first and the last.
PixelRect room_between(const OuterHits& hits, int n);

/// An image of a layer in which nothing is covered.
ViewImage blank_layer(int n, Axis axis, int layer);

/// Peels with `shader` until a pass draws nothing. A fragment that alpha test or blending lets nobody see is
/// peeled too, and passed over in the same layer. Not usable where the fixed fragment stage and the shader do
/// not see a fragment at the same depth to the bit.
AxisLayers peel_axis(const LayerTask& task, const PeelShader& shader, const OuterHits& hits,
                     const LayerSink& sink);

} // namespace glcast
