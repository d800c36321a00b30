#include "shim/preload/mask.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "capture/gl/call_classes.h"

namespace glcast::preload {
namespace {

constexpr std::string_view float_extensions[] = {"GL_ARB_color_buffer_float", "GL_ARB_texture_float",
                                                 "GL_ATI_texture_float"};
constexpr std::string_view framebuffer_extensions[] = {
    "GL_ARB_framebuffer_object", "GL_EXT_framebuffer_object", "GL_EXT_framebuffer_blit"};

/// The functions of a table are plain ones, so what they need stands here.
struct Masked {
    GlTable table;
    decltype(GlTable::GetString) get_string;
    Mask mask;
    std::string extensions;
};
Masked* masked = nullptr; // made once, never destroyed

bool is_masked(std::string_view name) {
    const auto among = [&](const auto& list) {
        for (const std::string_view entry : list)
            if (entry == name) return true;
        return false;
    };
    return (masked->mask.floats && among(float_extensions)) ||
           (masked->mask.framebuffers && among(framebuffer_extensions));
}

const GLubyte* APIENTRY get_string(GLenum name) {
    const GLubyte* text = masked->get_string(name);
    if (name != GL_EXTENSIONS || !text) return text;
    const std::string_view all(reinterpret_cast<const char*>(text));
    masked->extensions.clear();
    for (std::size_t at = 0; at < all.size();) {
        const std::size_t end = std::min(all.find(' ', at), all.size());
        const std::string_view extension = all.substr(at, end - at);
        if (!is_masked(extension)) masked->extensions.append(extension) += ' ';
        at = end + 1;
    }
    return reinterpret_cast<const GLubyte*>(masked->extensions.c_str());
}

void APIENTRY no_bits(GLenum, GLenum, GLint* value) { *value = 0; }

enum When : unsigned { each_time = 1, no_framebuffers = 2, no_queries = 4 };
constexpr const char* when_names[] = {"always", "fbo", "queries"};

using G = GlTable;

constexpr OverrideRule rules[] = {
    {each_time, replace<get_string>(only<&G::GetString>), "GL_EXTENSIONS without what is masked"},
    {no_framebuffers,
     drop(calls::framebuffer_bindings + only<&G::GenFramebuffers, &G::GenRenderbuffers, &G::BindRenderbuffer,
                                             &G::BindRenderbufferEXT, &G::CheckFramebufferStatus>),
     "the entry points are there, as glvnd has them, and do nothing"},
    {no_queries, replace<no_bits>(only<&G::GetQueryiv>), "no counter of samples"},
};

} // namespace

constinit const OverrideRules mask_rules = {"A driver that lacks something",
                                            "GLCAST_MASK, for tests: what the capture sees of the driver",
                                            rules, when_names};

const GlTable& masked_table(const GlTable& real, const Mask& mask) {
    if (masked || !mask.any()) return masked ? masked->table : real;
    masked = new Masked{real, real.GetString, mask, {}};
    override_calls(masked->table, real, rules,
                   each_time | (mask.framebuffers ? no_framebuffers : 0u) | (mask.queries ? no_queries : 0u));
    return masked->table;
}

} // namespace glcast::preload
