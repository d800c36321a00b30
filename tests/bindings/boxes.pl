# The three boxes of tests/preload/programs/chiral.c by Perl's OpenGL and GLUT.
use strict;
use warnings;
use OpenGL qw(:all);

my @boxes = ([[0, 0, 0], [1, 1, 3]], [[1, 0, 0], [3, 1, 1]], [[0, 1, 2], [1, 2, 3]]);
my @faces = ([0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]);
my @normals = ([-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]);

sub draw {
    glViewport(0, 0, 300, 300);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-1, 1, -1, 1, 2, 40);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslatef(-1, -1, -9);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glBegin(GL_QUADS);
    for my $box (@boxes) {
        for my $face (0 .. 5) {
            glNormal3f(@{$normals[$face]});
            glVertex3f($box->[$_ & 1][0], $box->[($_ >> 1) & 1][1], $box->[($_ >> 2) & 1][2]) for @{$faces[$face]};
        }
    }
    glEnd();
    glutSwapBuffers();
    glutPostRedisplay();
}

glutInit();
glutInitDisplayMode(GLUT_RGB | GLUT_DOUBLE | GLUT_DEPTH);
glutInitWindowSize(300, 300);
glutCreateWindow("boxes");
glutDisplayFunc(\&draw);
glutMainLoop();
