// GLCAST_PRETEND: a driver that has an old OpenGL and no shaders, played to the program on one that has more.
// What the program is told changes; the driver, and what we ask it, do not.
#pragma once
#include <atomic>
#include <optional>
#include <vector>

#include "capture/gl/gl_table.h"

namespace glcast::preload {

/// Set once, when the session begins; read by the stubs that tell of versions and extensions.
extern std::atomic<bool> pretending __attribute__((visibility("hidden")));

/// Asked of a process that may have no session yet.
bool pretends();

/// What a program is told in the current context. Contexts of OpenGL ES, and those whose version is not above
/// the pretended one, are told of as they are.
struct Told {
    const GlTable& real;

    /// GL_SHADING_LANGUAGE_VERSION is an invalid enum below 2.0. Strings live for ever.
    const GLubyte* GetString(GLenum name) const noexcept;
    const GLubyte* GetStringi(GLenum name, GLuint index) const noexcept;
    void GetBooleanv(GLenum name, GLboolean* values) const noexcept;
    void GetDoublev(GLenum name, GLdouble* values) const noexcept;
    void GetFloatv(GLenum name, GLfloat* values) const noexcept;
    void GetInteger64v(GLenum name, GLint64* values) const noexcept;
    void GetIntegerv(GLenum name, GLint* values) const noexcept;
};

/// Of a string that GLX keeps: without the extensions that tell of newer contexts. `text` itself where
/// nothing is hidden.
const char* told_window_extensions(const char* text) noexcept;

/// Is this a name for which a GetProcAddress has nothing to give? Shader calls that the pretended version has
/// not, and GLX calls for newer contexts.
bool hides_entry(const char* name) noexcept;

/// Where the attributes of a context (pairs, closed by `end`) ask for more than the pretended version: the
/// same, but for a version that no driver has, so that the driver refuses in its own way. Said once.
std::optional<std::vector<int>> refused_attributes(const int* attributes, int end, int major_key,
                                                   int minor_key);

} // namespace glcast::preload
