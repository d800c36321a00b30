// The figures of the paper, drawn from our casts.
#pragma once
#include <filesystem>

namespace glcast::paper {

/// Writes paper-figure-1.png .. paper-figure-5.png into `folder`.
void write_figures(const std::filesystem::path& folder);

} // namespace glcast::paper
