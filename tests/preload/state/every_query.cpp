#include "tests/preload/state/every_query.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <sstream>
#include <vector>

namespace glcast::test {
namespace {

struct Name {
    const char* text;
    GLenum value;
};
constexpr Name names[] = {
#include "generated/gl_enums.inc"
};

/// They tell the time, or what other processes leave of the memory; Mesa 22.3's software drivers fall over
/// LUID and NODE_MASK.
bool is_left_out(const std::string& name) {
    for (const char* part :
         {"TIMESTAMP", "TIME_ELAPSED", "CURRENT_TIME", "MEMORY", "EVICTED", "EVICTION", "LUID", "NODE_MASK"})
        if (name.find(part) != std::string::npos) return true;
    return false;
}

constexpr GLenum texture_targets[] = {GL_TEXTURE_1D,       GL_TEXTURE_2D,        GL_TEXTURE_3D,
                                      GL_TEXTURE_CUBE_MAP, GL_TEXTURE_RECTANGLE, GL_TEXTURE_1D_ARRAY,
                                      GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BUFFER};
constexpr GLenum image_targets[] = {GL_TEXTURE_1D,
                                    GL_TEXTURE_2D,
                                    GL_TEXTURE_3D,
                                    GL_TEXTURE_CUBE_MAP_POSITIVE_X,
                                    GL_TEXTURE_CUBE_MAP_NEGATIVE_Z,
                                    GL_TEXTURE_RECTANGLE,
                                    GL_PROXY_TEXTURE_2D};
constexpr GLenum buffer_targets[] = {
    GL_ARRAY_BUFFER,        GL_ELEMENT_ARRAY_BUFFER, GL_PIXEL_PACK_BUFFER,
    GL_PIXEL_UNPACK_BUFFER, GL_COPY_READ_BUFFER,     GL_COPY_WRITE_BUFFER,
    GL_UNIFORM_BUFFER,      GL_TEXTURE_BUFFER,       GL_TRANSFORM_FEEDBACK_BUFFER};
constexpr GLenum attachments[] = {GL_COLOR_ATTACHMENT0,
                                  GL_COLOR_ATTACHMENT1,
                                  GL_DEPTH_ATTACHMENT,
                                  GL_STENCIL_ATTACHMENT,
                                  GL_BACK_LEFT,
                                  GL_FRONT_LEFT,
                                  GL_DEPTH,
                                  GL_STENCIL};
constexpr GLenum query_targets[] = {GL_SAMPLES_PASSED, GL_ANY_SAMPLES_PASSED, GL_PRIMITIVES_GENERATED,
                                    GL_TIME_ELAPSED, GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN};
constexpr GLenum program_targets[] = {GL_VERTEX_PROGRAM_ARB, GL_FRAGMENT_PROGRAM_ARB};
constexpr int units = 8, attributes = 16, indices = 4, levels = 3;
constexpr GLuint names_looked_at = 64; ///< objects and lists 1 ... this

class Dump {
  public:
    Dump(const GlTable& table, const Memory& client) : gl(table), memory(client) {}

    /// Puts every enum to `ask(name, out)`; prints what it writes into `out`. The words of `what` name the
    /// query; where GL took some enums once, only these are put to it again with other numbers.
    template <class T> void each(const std::string& what, const std::function<void(GLenum, T*)>& ask) {
        std::vector<Name>& taken = known[without_numbers(what)];
        const bool first = taken.empty();
        const auto put = [&](const Name& name) {
            if (one<T>(what + ' ' + name.text, [&](T* out) { ask(name.value, out); }) && first)
                found.push_back(name);
        };
        found.clear();
        if (first)
            for (const Name& name : names) is_left_out(name.text) ? void() : put(name);
        else
            for (const Name& name : taken) put(name);
        if (first) taken = found;
    }

    /// Whether GL took it.
    template <class T> bool one(const std::string& what, const std::function<void(T*)>& ask) {
        static std::vector<T> out(4096);
        std::memset(out.data(), unwritten, out.size() * sizeof(T));
        ask(out.data());
        if (gl.GetError() != GL_NO_ERROR) return false;
        T mark;
        std::memset(&mark, unwritten, sizeof mark);
        std::size_t count = out.size();
        while (count > 0 && std::memcmp(&out[count - 1], &mark, sizeof mark) == 0) --count;
        if (count == 0) return true;
        text << what;
        for (std::size_t i = 0; i < count; ++i) print(out[i]);
        text << '\n';
        return true;
    }

    void line(const std::string& what, std::uint64_t number) { text << what << ' ' << number << '\n'; }
    std::string result() const { return text.str(); }

    const GlTable& gl;

  private:
    static constexpr int unwritten = 0x5A;
    static std::string without_numbers(std::string what) {
        std::erase_if(what, [](char c) { return c >= '0' && c <= '9'; });
        return what;
    }
    template <class T> void print(const T& value) { text << ' ' << +value; }
    void print(void* const& pointer) {
        const auto offset = static_cast<const char*>(pointer) - memory.base;
        const bool inside = offset >= 0 && std::size_t(offset) < memory.bytes;
        text << (inside ? " memory+" : " ") << (inside ? std::uint64_t(offset) : std::uint64_t(pointer));
    }

    const Memory memory;
    std::ostringstream text;
    std::map<std::string, std::vector<Name>> known;
    std::vector<Name> found;
};

std::string numbered(const char* what, std::uint64_t number) {
    return std::string(what) + ' ' + std::to_string(number);
}

std::uint64_t hash(const std::vector<unsigned char>& bytes) {
    std::uint64_t sum = 14695981039346656037u;
    for (const unsigned char byte : bytes) sum = (sum ^ byte) * 1099511628211u;
    return sum;
}

void dump_plain(Dump& d) {
    const GlTable& gl = d.gl;
    d.each<GLint>("integer", [&](GLenum e, GLint* out) { gl.GetIntegerv(e, out); });
    d.each<GLdouble>("double", [&](GLenum e, GLdouble* out) { gl.GetDoublev(e, out); });
    d.each<GLboolean>("enabled", [&](GLenum e, GLboolean* out) { *out = gl.IsEnabled(e); });
    d.each<void*>("pointer", [&](GLenum e, void** out) { gl.GetPointerv(e, out); });
    for (GLuint i = 0; i < indices; ++i) {
        d.each<GLint>(numbered("integer", i), [&](GLenum e, GLint* out) { gl.GetIntegeri_v(e, i, out); });
        d.each<GLdouble>(numbered("double", i), [&](GLenum e, GLdouble* out) { gl.GetDoublei_v(e, i, out); });
        d.each<GLboolean>(numbered("enabled", i),
                          [&](GLenum e, GLboolean* out) { *out = gl.IsEnabledi(e, i); });
    }
    d.each<GLdouble>("clip plane", [&](GLenum e, GLdouble* out) { gl.GetClipPlane(e, out); });
    for (const GLenum what : {GL_ORDER, GL_DOMAIN, GL_COEFF})
        d.each<GLdouble>(numbered("map", what), [&](GLenum e, GLdouble* out) { gl.GetMapdv(e, what, out); });
    for (GLenum light = GL_LIGHT0; light < GL_LIGHT0 + 8; ++light)
        d.each<GLfloat>(numbered("light", light),
                        [&](GLenum e, GLfloat* out) { gl.GetLightfv(light, e, out); });
    for (const GLenum face : {GL_FRONT, GL_BACK})
        d.each<GLfloat>(numbered("material", face),
                        [&](GLenum e, GLfloat* out) { gl.GetMaterialfv(face, e, out); });
}

void dump_unit(Dump& d, int unit) {
    const GlTable& gl = d.gl;
    gl.ActiveTexture(GLenum(GL_TEXTURE0 + unit));
    gl.ClientActiveTexture(GLenum(GL_TEXTURE0 + unit));
    const std::string prefix = numbered("unit", std::uint64_t(unit)) + ' ';
    d.each<GLdouble>(prefix, [&](GLenum e, GLdouble* out) { gl.GetDoublev(e, out); });
    d.each<GLboolean>(prefix + "enabled", [&](GLenum e, GLboolean* out) { *out = gl.IsEnabled(e); });
    d.each<void*>(prefix + "pointer", [&](GLenum e, void** out) { gl.GetPointerv(e, out); });
    for (const GLenum target : {GL_TEXTURE_ENV, GL_TEXTURE_FILTER_CONTROL, GL_POINT_SPRITE})
        d.each<GLfloat>(prefix + numbered("environment", target),
                        [&](GLenum e, GLfloat* out) { gl.GetTexEnvfv(target, e, out); });
    for (const GLenum coordinate : {GL_S, GL_T, GL_R, GL_Q})
        d.each<GLdouble>(prefix + numbered("generation", coordinate),
                         [&](GLenum e, GLdouble* out) { gl.GetTexGendv(coordinate, e, out); });
    for (const GLenum target : texture_targets)
        d.each<GLfloat>(prefix + numbered("texture", target),
                        [&](GLenum e, GLfloat* out) { gl.GetTexParameterfv(target, e, out); });
}

/// What is written by way of the pack buffer, where one is bound.
void dump_images(Dump& d) {
    const GlTable& gl = d.gl;
    GLint pack_buffer = 0;
    gl.GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack_buffer);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    d.each<GLfloat>("pixel map", [&](GLenum e, GLfloat* out) { gl.GetPixelMapfv(e, out); });
    d.one<GLubyte>("polygon stipple", [&](GLubyte* out) { gl.GetPolygonStipple(out); });
    for (const GLenum target : image_targets)
        for (GLint level = 0; level < levels; ++level) {
            const std::string what = numbered("image", target) + ' ' + std::to_string(level);
            d.each<GLint>(what,
                          [&](GLenum e, GLint* out) { gl.GetTexLevelParameteriv(target, level, e, out); });
            GLint size[3] = {};
            gl.GetTexLevelParameteriv(target, level, GL_TEXTURE_WIDTH, &size[0]);
            gl.GetTexLevelParameteriv(target, level, GL_TEXTURE_HEIGHT, &size[1]);
            gl.GetTexLevelParameteriv(target, level, GL_TEXTURE_DEPTH, &size[2]);
            const std::size_t texels =
                std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(std::max(size[2], 1));
            if (target == GL_PROXY_TEXTURE_2D || texels == 0 || gl.GetError()) continue;
            // Room for any row length and skipped rows of the program's pack state.
            std::vector<unsigned char> pixels((texels + 65536) * 16);
            gl.GetTexImage(target, level, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
            if (gl.GetError() == GL_NO_ERROR) d.line(what + " contents", hash(pixels));
        }
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(pack_buffer));
}

void dump_objects(Dump& d) {
    const GlTable& gl = d.gl;
    for (const GLenum target : buffer_targets) {
        d.each<GLint>(numbered("buffer", target),
                      [&](GLenum e, GLint* out) { gl.GetBufferParameteriv(target, e, out); });
        GLint bytes = 0;
        gl.GetBufferParameteriv(target, GL_BUFFER_SIZE, &bytes);
        std::vector<unsigned char> contents(std::size_t(std::max(bytes, 0)));
        gl.GetBufferSubData(target, 0, bytes, contents.data());
        if (gl.GetError() == GL_NO_ERROR) d.line(numbered("contents of buffer", target), hash(contents));
    }
    for (const GLenum target : {GL_DRAW_FRAMEBUFFER, GL_READ_FRAMEBUFFER}) {
        d.one<GLenum>(numbered("framebuffer", target),
                      [&](GLenum* out) { *out = gl.CheckFramebufferStatus(target); });
        for (const GLenum attachment : attachments)
            d.each<GLint>(numbered("framebuffer", target) + ' ' + std::to_string(attachment),
                          [&](GLenum e, GLint* out) {
                              gl.GetFramebufferAttachmentParameteriv(target, attachment, e, out);
                          });
    }
    d.each<GLint>("renderbuffer",
                  [&](GLenum e, GLint* out) { gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, e, out); });
    for (const GLenum target : query_targets)
        d.each<GLint>(numbered("query", target),
                      [&](GLenum e, GLint* out) { gl.GetQueryiv(target, e, out); });
    for (GLuint name = 1; name < 8; ++name) {
        d.each<GLint>(numbered("query object", name),
                      [&](GLenum e, GLint* out) { gl.GetQueryObjectiv(name, e, out); });
        d.each<GLfloat>(numbered("sampler", name),
                        [&](GLenum e, GLfloat* out) { gl.GetSamplerParameterfv(name, e, out); });
        d.each<GLint>(numbered("program", name),
                      [&](GLenum e, GLint* out) { gl.GetProgramiv(name, e, out); });
        d.each<GLint>(numbered("shader", name), [&](GLenum e, GLint* out) { gl.GetShaderiv(name, e, out); });
    }
    for (const GLenum target : program_targets) {
        d.each<GLint>(numbered("assembly program", target),
                      [&](GLenum e, GLint* out) { gl.GetProgramivARB(target, e, out); });
        for (GLuint i = 0; i < 8; ++i) {
            d.one<GLdouble>(numbered("environment", target) + ' ' + std::to_string(i),
                            [&](GLdouble* out) { gl.GetProgramEnvParameterdvARB(target, i, out); });
            d.one<GLdouble>(numbered("local", target) + ' ' + std::to_string(i),
                            [&](GLdouble* out) { gl.GetProgramLocalParameterdvARB(target, i, out); });
        }
    }
    for (GLuint i = 0; i < attributes; ++i) {
        d.each<GLdouble>(numbered("attribute", i),
                         [&](GLenum e, GLdouble* out) { gl.GetVertexAttribdv(i, e, out); });
        d.each<void*>(numbered("attribute", i),
                      [&](GLenum e, void** out) { gl.GetVertexAttribPointerv(i, e, out); });
    }
}

void dump_names(Dump& d) {
    const GlTable& gl = d.gl;
    using Is = GLboolean(APIENTRYP)(GLuint);
    struct Kind {
        const char* name;
        Is GlTable::*is;
    };
    const Kind kinds[] = {{"list", &GlTable::IsList},
                          {"texture", &GlTable::IsTexture},
                          {"buffer", &GlTable::IsBuffer},
                          {"framebuffer", &GlTable::IsFramebuffer},
                          {"renderbuffer", &GlTable::IsRenderbuffer},
                          {"query", &GlTable::IsQuery},
                          {"sampler", &GlTable::IsSampler},
                          {"vertex array", &GlTable::IsVertexArray},
                          {"program", &GlTable::IsProgram},
                          {"shader", &GlTable::IsShader},
                          {"assembly program", &GlTable::IsProgramARB},
                          {"pipeline", &GlTable::IsProgramPipeline},
                          {"transform feedback", &GlTable::IsTransformFeedback}};
    for (const Kind& kind : kinds)
        for (GLuint name = 1; name <= names_looked_at; ++name)
            if ((gl.*kind.is)(name)) d.line("there is " + std::string(kind.name), name);
    while (gl.GetError() != GL_NO_ERROR) {
    }
}

} // namespace

std::string every_query(const GlTable& gl, const Memory& memory) {
    Dump dump(gl, memory);
    GLint unit = 0, client_unit = 0;
    gl.GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    gl.GetIntegerv(GL_CLIENT_ACTIVE_TEXTURE, &client_unit);
    dump_plain(dump);
    dump_images(dump);
    dump_objects(dump);
    dump_names(dump);
    for (int i = 0; i < units; ++i) dump_unit(dump, i);
    gl.ActiveTexture(GLenum(unit));
    gl.ClientActiveTexture(GLenum(client_unit));
    return dump.result();
}

std::string pop_every_stack(const GlTable& gl, const Memory& memory) {
    std::ostringstream text;
    struct Stack {
        GLenum mode, depth, matrix;
    };
    for (const Stack& stack : {Stack{GL_MODELVIEW, GL_MODELVIEW_STACK_DEPTH, GL_MODELVIEW_MATRIX},
                               Stack{GL_PROJECTION, GL_PROJECTION_STACK_DEPTH, GL_PROJECTION_MATRIX},
                               Stack{GL_TEXTURE, GL_TEXTURE_STACK_DEPTH, GL_TEXTURE_MATRIX}}) {
        gl.MatrixMode(stack.mode);
        for (GLint depth = 0; gl.GetIntegerv(stack.depth, &depth), depth > 0;) {
            GLdouble m[16] = {};
            gl.GetDoublev(stack.matrix, m);
            text << "matrix " << stack.mode << ' ' << depth;
            for (const GLdouble value : m) text << ' ' << value;
            text << '\n';
            if (depth == 1) break;
            gl.PopMatrix();
        }
    }
    for (GLint depth = 0; gl.GetIntegerv(GL_CLIENT_ATTRIB_STACK_DEPTH, &depth), depth > 0;) {
        gl.PopClientAttrib();
        text << "client attributes " << depth << '\n' << every_query(gl, memory);
    }
    for (GLint depth = 0; gl.GetIntegerv(GL_ATTRIB_STACK_DEPTH, &depth), depth > 0;) {
        gl.PopAttrib();
        text << "attributes " << depth << '\n' << every_query(gl, memory);
    }
    return text.str();
}

} // namespace glcast::test
