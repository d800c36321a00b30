// An off-screen GL context for tests: Mesa's OSMesa, software, no X.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "capture/gl/gl_table.h"

namespace glcast::test {

/// Compatibility profile, 24-bit depth, 8-bit stencil, RGBA8 colour. Current on this thread once constructed.
/// Throws std::runtime_error when Mesa gives none.
class OsmesaContext {
  public:
    explicit OsmesaContext(int width = 64, int height = 64, OsmesaContext* share = nullptr);
    ~OsmesaContext();
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    void make_current();
    static void release(); ///< no context current on this thread

    /// Entry points. One may be there and still be a stub that only raises GL_INVALID_OPERATION: ask
    /// GL_EXTENSIONS.
    const GlTable& gl() const;
    int width() const;
    int height() const;

    /// The context's own colour buffer after glFinish: RGBA8, row 0 is the bottom. Makes the context current.
    std::vector<std::uint8_t> read_rgba();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl;
};

} // namespace glcast::test
