// Ctrl-C, or a polite end by somebody else, at any time of long work.
#pragma once

namespace glcast::cli {

/// From now on SIGINT, SIGTERM and SIGHUP, but those ignored so far (nohup), remove what was being written, say so in one line
/// and end the process with 128 + signal. To be called before there are threads: they must not take these signals.
void end_cleanly_on_signals();

} // namespace glcast::cli
