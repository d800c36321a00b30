// Texture objects of our own that a replay binds in place of textures which the program changed later in the
// frame.
#pragma once
#include <unordered_map>
#include <vector>

#include "shim/record/context.h"
#include "shim/record/default_textures.h"

namespace glcast::record {

/// Which copy of each texture the calls that are played now see.
class TextureStandIns {
  public:
    TextureStandIns(const Frame& frame, const GlTable& gl, const DefaultTextures& defaults);

    /// What to bind for the program's `name`: a copy, the texture itself, or that for the name 0 where it has
    /// been deleted.
    GLuint find(GLenum target, GLuint name) const;
    /// The program changes the texture that copy `number` is of.
    void end(std::uint32_t number, bool deleted);
    /// Binds what is seen now wherever a copy that has ended is bound.
    void refresh() const;

  private:
    const Frame& frame;
    const GlTable& gl;
    const DefaultTextures& defaults;
    std::vector<bool> ended, deleted;
    std::unordered_map<GLuint, std::vector<std::uint32_t>>
        copies; ///< of each name, those that have not ended, last first
};

/// The objects, unless an earlier replay made them. At the start of a replay.
void make_stand_ins(Player& player);

} // namespace glcast::record
