// Before the program closes a connection to the X server.
#pragma once

namespace glcast::preload {

/// `gone(display)` is called in XCloseDisplay, before the GL library lets go of it. Asks for nothing twice.
void call_before_close(void* display, void (*gone)(void* display));

} // namespace glcast::preload
