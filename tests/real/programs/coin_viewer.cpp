// The smallest viewer that Coin's users write: an examiner viewer in a Qt window, which shows an Open
// Inventor file.
#include <Inventor/Qt/SoQt.h>
#include <Inventor/Qt/viewers/SoQtExaminerViewer.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/nodes/SoSeparator.h>

#include <cstdio>

int main(int argc, char** argv) {
    QWidget* window = SoQt::init(argc, argv, argv[0]);
    SoInput input;
    SoSeparator* scene = argc == 2 && input.openFile(argv[1]) ? SoDB::readAll(&input) : nullptr;
    if (!scene) return std::fprintf(stderr, "usage: coin_viewer FILE.iv\n"), 2;
    scene->ref();
    SoQtExaminerViewer viewer(window);
    viewer.setSceneGraph(scene);
    viewer.show();
    SoQt::show(window);
    SoQt::mainLoop();
}
