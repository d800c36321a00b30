#include "shim/preload/pretence.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "shim/preload/host_thread.h"
#include "shim/preload/session.h"
#include "shim/preload/session_state.h"
#include "shim/preload/status.h"
#include "shim/preload/stub.h"

namespace glcast::preload {

constinit std::atomic<bool> pretending{false};

namespace {

/// Parts of extensions' names: shaders, and what is of no use without them.
constexpr std::string_view hidden_extensions[] = {"shader",
                                                  "Cg_",
                                                  "program",
                                                  "shading_language",
                                                  "glsl",
                                                  "spirv",
                                                  "vertex_attrib",
                                                  "attrib_location",
                                                  "uniform",
                                                  "transform_feedback",
                                                  "instanced",
                                                  "gpu_",
                                                  "ES2_compatibility",
                                                  "_ES3_",
                                                  "bindless_texture",
                                                  "compute_",
                                                  "enhanced_layouts",
                                                  "arrays_of_arrays",
                                                  "fragment_coord_conventions",
                                                  "fragment_layer_viewport",
                                                  "conservative_depth",
                                                  "cull_distance",
                                                  "texture_gather",
                                                  "texture_query_l",
                                                  "GL_ARB_compatibility"};

/// Parts of the names of calls, without gl.
constexpr std::string_view hidden_calls[] = {"Shader",
                                             "Program",
                                             "Uniform",
                                             "VertexAttrib",
                                             "AttribLocation",
                                             "ActiveAttrib",
                                             "FragData",
                                             "Varying",
                                             "Subroutine",
                                             "Instanced",
                                             "TransformFeedback",
                                             "PatchParameter",
                                             "DispatchCompute",
                                             "InfoLogARB",
                                             "AttachedObjectsARB",
                                             "HandleARB",
                                             "AttachObjectARB",
                                             "DetachObjectARB",
                                             "DeleteObjectARB",
                                             "ObjectParameterfvARB",
                                             "ObjectParameterivARB"};

/// Beginnings of the names of GLX extensions, and of GLX calls.
constexpr std::string_view hidden_window_extensions[] = {
    "GLX_ARB_create_context", "GLX_EXT_create_context_es", "GLX_MESA_query_renderer"};
constexpr std::string_view hidden_window_calls[] = {"glXCreateContextAttribsARB", "glXQueryRenderer",
                                                    "glXQueryCurrentRenderer"};

constexpr int no_such_version = 9; ///< of a context: refused by every driver

template <class List> bool has_part(std::string_view name, const List& parts) {
    return std::any_of(std::begin(parts), std::end(parts),
                       [&](std::string_view part) { return name.find(part) != name.npos; });
}
template <class List> bool begins_with(std::string_view name, const List& beginnings) {
    return std::any_of(std::begin(beginnings), std::end(beginnings),
                       [&](std::string_view beginning) { return name.starts_with(beginning); });
}

bool is_hidden_extension(std::string_view name) { return has_part(name, hidden_extensions); }
bool is_hidden_window_extension(std::string_view name) { return begins_with(name, hidden_window_extensions); }

GlVersion pretended() { return *session().options.pretend; }

/// "4.5 (Compatibility Profile) Mesa": 4.5; of OpenGL ES, whose strings begin with letters, 0.0.
GlVersion version_in(const char* text) {
    char* end = nullptr;
    const long major = text ? std::strtol(text, &end, 10) : 0;
    const long minor = end && *end == '.' ? std::strtol(end + 1, nullptr, 10) : 0;
    return {int(major), int(minor)};
}

/// Texts made of the driver's, each once: what glGetString returns stays where it is.
const char* kept(const char* text, std::string (*change)(std::string_view)) noexcept {
    static std::mutex mutex;
    static auto* const texts = new std::map<std::pair<void*, std::string>, std::string>;
    try {
        const HostThread program;
        const std::lock_guard lock(mutex);
        const auto [at, is_new] = texts->try_emplace({reinterpret_cast<void*>(change), text});
        if (is_new) at->second = change(text);
        return at->second.c_str();
    } catch (const std::exception&) {
        return text;
    }
}

template <bool (*is_hidden)(std::string_view)> std::string without_hidden(std::string_view all) {
    std::string visible;
    for (std::size_t at = 0; at < all.size();) {
        const std::size_t end = std::min(all.find(' ', at), all.size());
        const std::string_view extension = all.substr(at, end - at);
        if (!extension.empty() && !is_hidden(extension)) visible.append(extension) += ' ';
        at = end + 1;
    }
    return visible;
}

/// "1.5 Mesa 22.3.6", of "4.5 (Compatibility Profile) Mesa 22.3.6": programs look for the vendor's words,
/// too.
std::string pretended_version(std::string_view real) {
    constexpr std::string_view profile = " (Compatibility Profile)";
    std::string_view vendor = real.substr(std::min(real.find(' '), real.size()));
    if (vendor.starts_with(profile)) vendor.remove_prefix(profile.size());
    const GlVersion version = pretended();
    return std::to_string(version.major) + "." + std::to_string(version.minor) + std::string(vendor);
}

const char* as_text(const GLubyte* text) { return reinterpret_cast<const char*>(text); }
const GLubyte* as_bytes(const char* text) { return reinterpret_cast<const GLubyte*>(text); }

/// Of the current context; 0.0 where it is told of as it is.
GlVersion version_to_hide(const GlTable& real) {
    const GlVersion version = version_in(as_text(real.GetString(GL_VERSION)));
    return version > pretended() ? version : GlVersion{};
}

/// Calls `see(name)` for each extension that is not hidden until that returns false.
template <class See> void each_visible(const GlTable& real, const See& see) {
    GLint count = 0;
    real.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const GLubyte* name = real.GetStringi(GL_EXTENSIONS, GLuint(i));
        if (name && !is_hidden_extension(as_text(name)) && !see(name)) return;
    }
}

bool asks_of_versions(GLenum name) {
    return name == GL_MAJOR_VERSION || name == GL_MINOR_VERSION || name == GL_NUM_EXTENSIONS ||
           name == GL_NUM_SHADING_LANGUAGE_VERSIONS;
}

long answer(const GlTable& real, GLenum name) {
    if (name == GL_MAJOR_VERSION) return pretended().major;
    if (name == GL_MINOR_VERSION) return pretended().minor;
    long count = 0;
    if (name == GL_NUM_EXTENSIONS) each_visible(real, [&](const GLubyte*) { return ++count > 0; });
    return count;
}

/// The driver has answered, or raised its error: since 3.0 it knows these names.
template <class Value> void amend(const GlTable& real, GLenum name, Value* values) noexcept {
    if (!asks_of_versions(name) || !values || version_to_hide(real).major < 3) return;
    const long number = answer(real, name);
    *values = std::is_same_v<Value, GLboolean> ? Value(number != 0) : Value(number);
}

const GLubyte* shading_language(const GlTable& real, const GLubyte* text) {
    const GlVersion version = pretended();
    if (!text || version_to_hide(real).major == 0) return text;
    if (version.major < 2) return real.GetString(0); // the driver's own error
    return as_bytes(version.minor == 0 ? "1.10" : "1.20");
}

} // namespace

bool pretends() {
    static const bool is_asked = [] {
        const char* text = std::getenv("GLCAST_PRETEND");
        return text && *text;
    }();
    return is_asked && session().options.pretend;
}

const GLubyte* Told::GetString(GLenum name) const noexcept {
    const GLubyte* text = real.GetString(name);
    if (!text) return text;
    if (name == GL_SHADING_LANGUAGE_VERSION) return shading_language(real, text);
    if (name != GL_VERSION && name != GL_EXTENSIONS) return text;
    if (version_to_hide(real).major == 0) return text;
    return as_bytes(
        kept(as_text(text), name == GL_VERSION ? pretended_version : without_hidden<is_hidden_extension>));
}

const GLubyte* Told::GetStringi(GLenum name, GLuint index) const noexcept {
    if ((name != GL_EXTENSIONS && name != GL_SHADING_LANGUAGE_VERSION) || version_to_hide(real).major < 3)
        return real.GetStringi(name, index);
    if (name == GL_SHADING_LANGUAGE_VERSION) return real.GetStringi(0, index); // the driver's own error
    const GLubyte* found = nullptr;
    each_visible(real, [&](const GLubyte* extension) {
        found = index == 0 ? extension : nullptr;
        return index-- != 0;
    });
    return found ? found : real.GetStringi(GL_EXTENSIONS, ~0u);
}

void Told::GetBooleanv(GLenum name, GLboolean* values) const noexcept {
    real.GetBooleanv(name, values);
    amend(real, name, values);
}
void Told::GetDoublev(GLenum name, GLdouble* values) const noexcept {
    real.GetDoublev(name, values);
    amend(real, name, values);
}
void Told::GetFloatv(GLenum name, GLfloat* values) const noexcept {
    real.GetFloatv(name, values);
    amend(real, name, values);
}
void Told::GetInteger64v(GLenum name, GLint64* values) const noexcept {
    real.GetInteger64v(name, values);
    amend(real, name, values);
}
void Told::GetIntegerv(GLenum name, GLint* values) const noexcept {
    real.GetIntegerv(name, values);
    amend(real, name, values);
}

const char* told_window_extensions(const char* text) noexcept {
    return text && pretends() ? kept(text, without_hidden<is_hidden_window_extension>) : text;
}

bool hides_entry(const char* name) noexcept {
    if (!name || !pretends()) return false;
    if (begins_with(name, hidden_window_calls)) return true;
    if (std::strncmp(name, "gl", 2) != 0 || name[2] == 'X' || !has_part(name + 2, hidden_calls)) return false;
    const auto end = gl_call_names + gl_call_count;
    const auto at = std::lower_bound(gl_call_names, end, name,
                                     [](const char* a, const char* b) { return std::strcmp(a, b) < 0; });
    const bool is_known = at != end && std::strcmp(*at, name) == 0;
    const GlVersion version = pretended();
    return !is_known || core_versions[at - gl_call_names] > 10 * version.major + version.minor;
}

std::optional<std::vector<int>> refused_attributes(const int* attributes, int end, int major_key,
                                                   int minor_key) {
    if (!attributes || !pretends()) return std::nullopt;
    GlVersion asked{1, 0};
    for (const int* at = attributes; *at != end; at += 2)
        if (*at == major_key || *at == minor_key) (*at == major_key ? asked.major : asked.minor) = at[1];
    const GlVersion most = pretended();
    if (!(asked > most)) return std::nullopt;
    const HostThread program;
    std::vector<int> changed;
    for (const int* at = attributes; *at != end; at += 2)
        changed.insert(changed.end(), {*at, *at == major_key ? no_such_version : at[1]});
    changed.push_back(end);
    const std::string why = "it asked for a context of OpenGL " + std::to_string(asked.major) + "." +
                            std::to_string(asked.minor) + ", and was told that there are none above " +
                            std::to_string(most.major) + "." + std::to_string(most.minor) + " (--pretend)";
    say_once("%s", why.c_str());
    tell("refused", why);
    return changed;
}

} // namespace glcast::preload
