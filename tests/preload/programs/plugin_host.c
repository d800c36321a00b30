// Opens a plugin that draws with GL; knows nothing of GL itself. plugin_host NAME [deepbind]
// A NAME without a slash is found through this program's own RUNPATH, which is $ORIGIN/plugins.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

int main(int argc, char** argv) {
    if (argc < 2) return 20;
    // No GL is here yet, and nobody may make it look as if it were.
    if (dlsym(RTLD_DEFAULT, "glVertex3f") || dlsym(RTLD_NEXT, "no_such_function")) return 21;
    int flags = RTLD_NOW | RTLD_LOCAL;
    if (argc > 2 && strcmp(argv[2], "deepbind") == 0) flags |= RTLD_DEEPBIND;
    void* plugin = dlopen(argv[1], flags);
    if (!plugin) {
        fprintf(stderr, "%s\n", dlerror());
        return 22;
    }
    int (*draw)(int, void (*)(int)) = (int (*)(int, void (*)(int)))dlsym(plugin, "draw_cubes");
    return draw ? draw(3, 0) : 23;
}
