// Whether a flush ends a frame: it does for who draws to the front buffer.
#pragma once

namespace glcast::preload {

/// This thread chose the front buffer since its last frame ended, or draws to it now. Asks the current
/// context.
bool draws_to_front();

/// On this thread a frame ended, or another context or drawable became current.
void forget_front();

} // namespace glcast::preload
