"""The three boxes of tests/preload/programs/chiral.c by PyOpenGL and GLUT."""
from OpenGL.GL import *
from OpenGL.GLUT import *

BOXES = [((0, 0, 0), (1, 1, 3)), ((1, 0, 0), (3, 1, 1)), ((0, 1, 2), (1, 2, 3))]
FACES = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
NORMALS = [(-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1)]


def draw():
    glViewport(0, 0, 300, 300)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    glFrustum(-1, 1, -1, 1, 2, 40)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    glTranslatef(-1, -1, -9)
    glEnable(GL_DEPTH_TEST)
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    # What Python is good at: one array for all.
    vertices, normals = [], []
    for lo, hi in BOXES:
        for face, normal in zip(FACES, NORMALS):
            for c in face:
                vertices.append([hi[0] if c & 1 else lo[0], hi[1] if c & 2 else lo[1], hi[2] if c & 4 else lo[2]])
                normals.append(normal)
    glEnableClientState(GL_VERTEX_ARRAY)
    glEnableClientState(GL_NORMAL_ARRAY)
    glVertexPointerf(vertices)
    glNormalPointerf(normals)
    glDrawArrays(GL_QUADS, 0, len(vertices))
    glutSwapBuffers()
    glutPostRedisplay()


glutInit()
glutInitDisplayMode(GLUT_RGB | GLUT_DOUBLE | GLUT_DEPTH)
glutInitWindowSize(300, 300)
glutCreateWindow(b"boxes")
glutDisplayFunc(draw)
glutMainLoop()
