/* A body for the programs of this folder, drawn in whatever context is current. */
#pragma once

/* A box from lo to hi; faces counter-clockwise from outside, flat normals. */
void draw_box(const float lo[3], const float hi[3]);
/* Three boxes: an L with a flag on it, that no rotation takes to its mirror image. chiral_boxes[i] is lo, hi.
 */
extern const float chiral_boxes[3][2][3];
void draw_chiral(void);
/* Clears a window so many pixels wide, and looks at them in perspective with a depth test. */
void look_at_chiral(int size);
