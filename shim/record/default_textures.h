// Texture objects of our own that a replay binds in place of those named 0.
//
// Whether contexts share the textures named 0 is for the driver to say. Mesa 22.3 shares them, and a context
// that has drawn from one leaves it a pointer to itself when it is destroyed (st_destroy_context looks at
// named textures only), which the next upload follows: a replay must not draw from them, nor write to them.
#pragma once
#include <map>
#include <vector>

#include "shim/record/context.h"

namespace glcast::record {

class Player;
using PlayFunction = void (*)(Player&, const Packet&);

/// Made only where an image goes into one, for most programs never do that and each takes up a name. Live as
/// long as the frame.
class DefaultTextures {
  public:
    DefaultTextures(const Frame& frame, const GlTable& gl);

    /// Before the prologue, which fills what was not empty when the frame began.
    void begin(Player& player);
    /// What to bind for the texture named 0.
    GLuint find(GLenum target) const;
    /// Plays what goes into the texture that is bound to a target (or a face of a cube), if that is the one
    /// named 0.
    void play_image(Player& player, const Packet& packet, PlayFunction play);
    void play_parameter(Player& player, const Packet& packet, PlayFunction play);
    void play_mipmap(Player& player, const Packet& packet, PlayFunction play);
    /// glPopAttrib may have brought back a 0 that was bound before ours was made.
    void attributes_were_popped() const;

  private:
    bool is_bound(GLenum target) const; ///< that of the target
    void make(Player& player, GLenum object);
    void bind_wherever_0_is(GLenum object, GLuint name) const;

    const Frame& frame;
    const GlTable& gl;
    struct Parameter {
        Packet packet;
        PlayFunction play;
    };
    std::map<GLenum, std::vector<Parameter>> parameters; ///< of those that are not made yet
};

} // namespace glcast::record
