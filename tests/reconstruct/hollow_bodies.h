// Bodies with cavities that no axis sees, in the tests' box.
#pragma once
#include "tests/reconstruct/bodies.h"

namespace glcast::test {

struct HollowBody {
    std::string name;
    BodyPtr body;
};

/// Cup tilted by 40 degrees, bent tube, bracket with tilted bores, fins one behind another, sphere in a
/// closed box, car-like shell with slits and open windows, bottle with a narrow neck.
std::vector<HollowBody> hollow_bodies();

} // namespace glcast::test
