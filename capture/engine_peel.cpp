#include "capture/engine_peel.h"

#include "capture/engine_target.h"

namespace glcast {

namespace {

// It reads the colour, whose shade model then cuts quads into triangles as it does in the colour pass: Mesa
// takes a quad strip in flat shading apart otherwise than in smooth shading, and other triangles have other
// depths.
constexpr const char* source = R"(#version 110
#extension GL_ARB_texture_rectangle : require
uniform sampler2DRect range;
uniform vec3 same;
void main() {
    float z = gl_FragCoord.z;
    float apart = min(same.x + same.y * (abs(dFdx(z)) + abs(dFdy(z))), same.z);
    vec3 r = texture2DRect(range, gl_FragCoord.xy).xyz;
    if (z <= r.y || z - r.x <= apart || r.z - z <= apart) discard;
    gl_FragColor = gl_Color;
}
)";

bool has_calls(const GlTable& gl) {
    return gl.CreateShader && gl.ShaderSource && gl.CompileShader && gl.CreateProgram && gl.AttachShader &&
           gl.LinkProgram && gl.GetProgramiv && gl.UseProgram && gl.DeleteShader && gl.DeleteProgram &&
           gl.GetUniformLocation && gl.Uniform1i && gl.Uniform3f && gl.ActiveTexture;
}

/// Asked before anything is called: entry points may be there and still be stubs of the loader's.
bool has_features(const GlTable& gl) {
    return has_calls(gl) && gl.GetString(GL_SHADING_LANGUAGE_VERSION) &&
           has_extension(gl, "GL_ARB_texture_float") && has_extension(gl, "GL_ARB_texture_rectangle");
}

void reset_unpack_state(const GlTable& gl) {
    constexpr GLenum zero[] = {GL_UNPACK_SWAP_BYTES,  GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH,
                               GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_IMAGES};
    for (GLenum name : zero) gl.PixelStorei(name, 0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (gl.BindBuffer) gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    constexpr GLenum scales[] = {GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE, GL_ALPHA_SCALE};
    constexpr GLenum biases[] = {GL_RED_BIAS, GL_GREEN_BIAS, GL_BLUE_BIAS, GL_ALPHA_BIAS};
    for (GLenum name : scales) gl.PixelTransferf(name, 1);
    for (GLenum name : biases) gl.PixelTransferf(name, 0);
    gl.PixelTransferi(GL_MAP_COLOR, GL_FALSE);
}

} // namespace

std::unique_ptr<PeelShader> PeelShader::make(const GlTable& gl, int n) {
    if (!has_features(gl)) return nullptr;
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_RECTANGLE_TEXTURE_SIZE, &largest);
    if (n > largest) return nullptr;
    std::unique_ptr<PeelShader> shader(new PeelShader(gl, n));
    swallow_errors(gl);
    const bool works = shader->link() && shader->make_texture() && gl.GetError() == GL_NO_ERROR;
    swallow_errors(gl);
    return works ? std::move(shader) : nullptr;
}

PeelShader::PeelShader(const GlTable& gl, int n) : gl(gl), n(n) {
    GLint units = 1;
    gl.GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
    unit = units > 0 ? units - 1 : 0;
}

PeelShader::~PeelShader() {
    gl.UseProgram(0);
    gl.DeleteProgram(program);
    gl.DeleteTextures(1, &texture);
}

bool PeelShader::link() {
    const GLuint shader = gl.CreateShader(GL_FRAGMENT_SHADER);
    gl.ShaderSource(shader, 1, &source, nullptr);
    gl.CompileShader(shader);
    program = gl.CreateProgram();
    gl.AttachShader(program, shader);
    gl.LinkProgram(program);
    gl.DeleteShader(shader); // lives on in the program
    GLint linked = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) return false;
    const float sample = 1.0f / static_cast<float>(n);
    gl.UseProgram(program);
    gl.Uniform1i(gl.GetUniformLocation(program, "range"), unit);
    gl.Uniform3f(gl.GetUniformLocation(program, "same"), SameHit::flat * sample, SameHit::per_slope,
                 SameHit::most * sample);
    gl.UseProgram(0);
    return true;
}

bool PeelShader::make_texture() {
    reset_unpack_state(gl);
    gl.GenTextures(1, &texture);
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_RECTANGLE, texture);
    gl.TexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexImage2D(GL_TEXTURE_RECTANGLE, 0, GL_RGB32F, n, n, 0, GL_RGB, GL_FLOAT, nullptr);
    gl.ActiveTexture(GL_TEXTURE0);
    return true;
}

void PeelShader::upload(const std::vector<PeelRange>& ranges, const PixelRect& only) const {
    reset_unpack_state(gl);
    gl.PixelStorei(GL_UNPACK_ROW_LENGTH, n);
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_RECTANGLE, texture);
    gl.TexSubImage2D(GL_TEXTURE_RECTANGLE, 0, only.x0, only.y0, only.x1 - only.x0, only.y1 - only.y0, GL_RGB,
                     GL_FLOAT, ranges.data() + std::size_t(only.y0) * n + only.x0);
    gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    gl.ActiveTexture(GL_TEXTURE0);
}

void PeelShader::use() const {
    gl.UseProgram(program);
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_RECTANGLE, texture);
    if (gl.BindSampler) gl.BindSampler(unit, 0);
    gl.ActiveTexture(GL_TEXTURE0);
}

} // namespace glcast
