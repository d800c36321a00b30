// The page docs/reference/overrides.md: what every override table makes of which calls, and why.
//
//   override_page PAGE           writes it
//   override_page PAGE --check   ends with 1 where the page is stale
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "capture/forced_table.h"
#include "shim/preload/mask.h"
#include "shim/preload/scene_table.h"
#include "shim/preload/scene_thumbnail.h"
#include "shim/preload/stencil_judge.h"

namespace {

using namespace glcast;

const OverrideRules* const tables[] = {&forced_rules, &preload::gate_rules, &preload::picture_rules,
                                       &preload::judge_rules, &preload::mask_rules};

constexpr const char* head = R"(# What override tables make of calls

Made by `tests/docs/override_page.cpp` of the tables of rules themselves. Do not edit it: `ninja overrides` writes it anew, and
the test `docs.overrides` fails when it is stale. [entry-points.md](entry-points.md) says which calls are recorded at all.

A frame is played into a table of GL calls. Each table below stands in for some of them, and passes the rest on. The last row
of a table that names a call counts. A call that the driver lacks stays missing.
)";

void (*marked(std::uintptr_t mark))() { return reinterpret_cast<void (*)()>(mark); }

GlTable filled(std::uintptr_t mark) {
    GlTable table;
    void (*const function)() = marked(mark);
    for (std::size_t i = 0; i < gl_call_count; ++i)
        std::memcpy(reinterpret_cast<char*>(&table) + i * sizeof function, &function, sizeof function);
    return table;
}

/// The calls that a change touches, found by making it.
std::string calls_of(const Change& change) {
    const GlTable before = filled(1), below = filled(2);
    GlTable after = before;
    change.install(after, below);
    std::string names;
    for (std::size_t i = 0; i < gl_call_count; ++i) {
        const std::size_t at = i * sizeof(void*);
        if (std::memcmp(reinterpret_cast<const char*>(&after) + at,
                        reinterpret_cast<const char*>(&before) + at, sizeof(void*)) != 0)
            names += (names.empty() ? "" : " ") + std::string(gl_call_names[i] + 2);
    }
    return names;
}

std::string when(const OverrideRules& table, unsigned bits) {
    std::string text;
    for (std::size_t i = 0; i < table.circumstances.size(); ++i)
        if (bits >> i & 1) text += (text.empty() ? "" : ", ") + std::string(table.circumstances[i]);
    return text;
}

void write(std::ostream& out, const OverrideRules& table) {
    out << "\n## " << table.name << "\n\n"
        << table.purpose << ".\n\n| calls | what happens | " << (table.circumstances.empty() ? "" : "when | ")
        << "why |\n|---|---|" << (table.circumstances.empty() ? "" : "---|") << "---|\n";
    for (const OverrideRule& rule : table.rules) {
        out << "| " << calls_of(rule.change) << " | " << rule.change.what << " | ";
        if (!table.circumstances.empty()) out << when(table, rule.when) << " | ";
        out << rule.why << " |\n";
    }
}

} // namespace

int main(int count, char** arguments) {
    if (count < 2) {
        std::cerr << "override_page PAGE [--check]\n";
        return 2;
    }
    std::ostringstream page;
    page << head;
    for (const OverrideRules* table : tables) write(page, *table);
    if (count == 2) return std::ofstream(arguments[1]) << page.str() ? 0 : 1;
    std::ifstream file(arguments[1]);
    std::ostringstream there;
    there << file.rdbuf();
    if (there.str() == page.str()) return 0;
    std::cerr << arguments[1] << " is stale: run `ninja overrides`\n";
    return 1;
}
