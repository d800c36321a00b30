// How the surface is coloured: as drawn, by its normals, or by its distance to level 0. All are display values.

/** From no error to the largest. */
export const ramp = ['#dfe6ea', '#f6d55c', '#ed8b3b', '#c8352e', '#6d0f2b'];

export const modes = { colour: 0, normal: 1, error: 2 };

const vec3 = (hex) => `vec3(${[1, 3, 5].map((i) => (parseInt(hex.slice(i, i + 2), 16) / 255).toFixed(4)).join(', ')})`;

export const vertexShader = `
uniform mat4 modelViewMatrix, projectionMatrix;
in vec4 place; // x, y, z, distance to level 0
in vec4 normal, colour, tangent;
in vec2 coordinate;
out vec3 vNormal, vColour, vEye;
out vec4 vTangent;
out vec2 vCoordinate;
out float vDistance;
void main() {
  vec4 eye = modelViewMatrix * vec4(place.xyz, 1.0);
  vEye = eye.xyz;
  vNormal = normal.xyz;
  vColour = colour.rgb;
  vDistance = place.w;
  vTangent = tangent;
  vCoordinate = coordinate;
  gl_Position = projectionMatrix * eye;
}`;

// The light comes from the camera. Faces may be wound either way, so a normal counts towards the viewer.
export const fragmentShader = `
precision highp float;
uniform mat3 turn; // model to eye
uniform int mode;
uniform bool hasNormals, hasColours, textured, bent;
uniform sampler2D colourMap, normalMap;
uniform float distanceScale; // of 1 to the whole ramp
in vec3 vNormal, vColour, vEye;
in float vDistance;
in vec4 vTangent;
in vec2 vCoordinate;
out vec4 fragment;
vec3 ramp(float x) {
  vec3 stops[${ramp.length}] = vec3[](${ramp.map(vec3).join(', ')});
  float at = clamp(x, 0.0, 1.0) * ${(ramp.length - 1).toFixed(1)};
  int from = min(int(at), ${ramp.length - 2});
  return mix(stops[from], stops[from + 1], at - float(from));
}
// As tools/mesh/texture.h has it: +y of the map is the bitangent.
vec3 modelNormal() {
  vec3 smoothNormal = normalize(vNormal);
  if (!bent || dot(vTangent.xyz, vTangent.xyz) == 0.0) return smoothNormal;
  vec3 along = normalize(vTangent.xyz);
  vec3 across = cross(smoothNormal, along) * sign(vTangent.w);
  vec3 map = texture(normalMap, vCoordinate).xyz * 2.0 - 1.0;
  return normalize(along * map.x + across * map.y + smoothNormal * map.z);
}
void main() {
  vec3 face = normalize(cross(dFdx(vEye), dFdy(vEye)));
  vec3 eyeNormal = hasNormals && dot(vNormal, vNormal) > 0.0 ? normalize(turn * modelNormal()) : face;
  if (mode == ${modes.normal}) {
    fragment = vec4((transpose(turn) * eyeNormal) * 0.5 + 0.5, 1.0);
    return;
  }
  if (mode == ${modes.error}) { // flat and pale, so that the colours can be read off
    fragment = vec4(ramp(vDistance * distanceScale) * mix(0.7, 1.0, abs(face.z)), 1.0);
    return;
  }
  vec3 colour = textured ? texture(colourMap, vCoordinate).rgb : hasColours ? vColour : vec3(0.78);
  fragment = vec4(colour * mix(0.45, 1.0, abs(eyeNormal.z)), 1.0);
}`;

export const wireFragmentShader = `
precision highp float;
out vec4 fragment;
void main() { fragment = vec4(0.08, 0.11, 0.13, 1.0); }`;
