#include "tools/view/template.h"

#ifdef GLCAST_PAGE_TEMPLATE
asm(".pushsection .rodata\n"
    ".global glcast_page_template\n"
    ".global glcast_page_template_end\n"
    "glcast_page_template:\n"
    ".incbin \"" GLCAST_PAGE_TEMPLATE "\"\n"
    "glcast_page_template_end:\n"
    ".byte 0\n"
    ".popsection\n");
extern "C" const char glcast_page_template[], glcast_page_template_end[];

namespace glcast::view {
std::string_view page_template() { return {glcast_page_template, glcast_page_template_end}; }
} // namespace glcast::view
#else
namespace glcast::view {
std::string_view page_template() { return {}; }
} // namespace glcast::view
#endif
