// The three boxes of tests/preload/programs/chiral.c by JOGL: Boxes canvas|panel.
import com.jogamp.opengl.*;
import com.jogamp.opengl.awt.*;
import com.jogamp.opengl.util.FPSAnimator;
import java.awt.Component;
import javax.swing.JFrame;

public class Boxes implements GLEventListener {
    private static final float[][][] BOXES = {{{0, 0, 0}, {1, 1, 3}}, {{1, 0, 0}, {3, 1, 1}}, {{0, 1, 2}, {1, 2, 3}}};
    private static final int[][] FACES = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    private static final float[][] NORMALS = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

    public static void main(String[] arguments) {
        GLCapabilities wanted = new GLCapabilities(GLProfile.get("GL2"));
        GLAutoDrawable picture = arguments[0].equals("panel") ? new GLJPanel(wanted) : new GLCanvas(wanted);
        picture.addGLEventListener(new Boxes());
        JFrame frame = new JFrame("boxes");
        frame.setSize(320, 340);
        frame.add((Component) picture);
        frame.setVisible(true);
        new FPSAnimator(picture, 30).start();
    }

    public void display(GLAutoDrawable picture) {
        GL2 gl = picture.getGL().getGL2();
        gl.glMatrixMode(GL2.GL_PROJECTION);
        gl.glLoadIdentity();
        gl.glFrustum(-1, 1, -1, 1, 2, 40);
        gl.glMatrixMode(GL2.GL_MODELVIEW);
        gl.glLoadIdentity();
        gl.glTranslatef(-1, -1, -9);
        gl.glEnable(GL.GL_DEPTH_TEST);
        gl.glClear(GL.GL_COLOR_BUFFER_BIT | GL.GL_DEPTH_BUFFER_BIT);
        gl.glBegin(GL2.GL_QUADS);
        for (float[][] box : BOXES)
            for (int face = 0; face < 6; ++face) {
                gl.glNormal3fv(NORMALS[face], 0);
                for (int c : FACES[face]) gl.glVertex3f(box[c & 1][0], box[c >> 1 & 1][1], box[c >> 2 & 1][2]);
            }
        gl.glEnd();
    }

    public void init(GLAutoDrawable picture) {}
    public void dispose(GLAutoDrawable picture) {}
    public void reshape(GLAutoDrawable picture, int x, int y, int width, int height) {}
}
