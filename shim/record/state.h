// State calls that need more than being written down: Begin/End, stacks, programs, selection.
#pragma once
#include "shim/record/context.h"

namespace glcast::record {

inline int stack_number(GLenum mode, int unit) {
    switch (mode) {
    case GL_MODELVIEW:
        return int(Stack::modelview);
    case GL_PROJECTION:
        return int(Stack::projection);
    case GL_COLOR:
        return int(Stack::colour);
    case GL_TEXTURE:
        return int(Stack::texture0) + unit;
    default:
        return -1;
    }
}

struct StackNames {
    GLenum mode, depth, matrix;
};
inline StackNames stack_names(int stack) {
    switch (Stack(stack)) {
    case Stack::modelview:
        return {GL_MODELVIEW, GL_MODELVIEW_STACK_DEPTH, GL_MODELVIEW_MATRIX};
    case Stack::projection:
        return {GL_PROJECTION, GL_PROJECTION_STACK_DEPTH, GL_PROJECTION_MATRIX};
    case Stack::colour:
        return {GL_COLOR, GL_COLOR_MATRIX_STACK_DEPTH, GL_COLOR_MATRIX};
    default:
        return {GL_TEXTURE, GL_TEXTURE_STACK_DEPTH, GL_TEXTURE_MATRIX};
    }
}

/// After a call that may have popped a matrix: if it brought to light an entry that lay below the top when
/// the frame began, writes it into the frame's stacks.
void note_popped_matrix(Context& context);

/// After a call that may have popped attributes: if they were pushed before the frame began, what was
/// restored is only known now, so the state is read as at a frame's start. Returns whether it was.
bool note_popped_attributes(Context& context);

} // namespace glcast::record
