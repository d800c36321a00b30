// A Qt 5 program: an odd body in a QOpenGLWidget beside a label. Qt gives the widget a framebuffer object,
// and puts its picture on the window with a context of its own. argv[1] "two": a second widget, that shows a
// cube.
#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QOpenGLWidget>
#include <QSurfaceFormat>
#include <QTimer>
#include <cstring>

extern "C" {
extern const float chiral_boxes[3][2][3];
void draw_box(const float lo[3], const float hi[3]);
void draw_chiral(void);
}

namespace {

class View : public QOpenGLWidget {
  public:
    explicit View(bool shows_cube) : shows_cube(shows_cube) { setMinimumSize(160, 160); }
    int frames = 0;

  protected:
    void paintGL() override {
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_LIGHTING);
        glEnable(GL_LIGHT0);
        glClearColor(1, 1, 1, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        glFrustum(-1, 1, -1, 1, 2, 40);
        glMatrixMode(GL_MODELVIEW);
        glLoadIdentity();
        glTranslatef(-1, -1, -12);
        const float lo[3] = {0, 0, 0}, hi[3] = {2, 2, 2};
        shows_cube ? draw_box(lo, hi) : draw_chiral();
        ++frames;
    }

  private:
    const bool shows_cube;
};

} // namespace

int main(int argc, char** argv) {
    QSurfaceFormat format;
    format.setDepthBufferSize(24);
    format.setProfile(QSurfaceFormat::CompatibilityProfile);
    QSurfaceFormat::setDefaultFormat(format);
    QApplication application(argc, argv);
    QWidget window;
    QHBoxLayout layout(&window);
    QLabel label("A body");
    View body(false), cube(true);
    layout.addWidget(&label);
    if (argc > 1 && std::strcmp(argv[1], "two") == 0) layout.addWidget(&cube);
    layout.addWidget(&body);
    window.show();
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, [&] {
        body.update(), cube.update();
        if (body.frames >= 10) application.quit();
    });
    timer.start(20);
    return application.exec();
}
