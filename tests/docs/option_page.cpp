// The tables of docs/reference/options.md, made of capture/option_table.h, and what glcast-run itself takes.
//
//   option_page PAGE           writes them
//   option_page PAGE --check   ends with 1 where the page is stale, or where glcast-run takes other options
#include <array>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <string>

#include "capture/option_table.h"
#include "tools/io/mesh_endings.h"

namespace {

using namespace glcast;

constexpr std::string_view first = "<!-- made by", last = "<!-- end -->";

std::string escaped(std::string_view text) {
    std::string all;
    for (const char c : text) all += c == '|' ? std::string("\\|") : std::string(1, c);
    return all;
}

std::set<std::string> names_of(std::string_view list) {
    std::set<std::string> names;
    std::istringstream words{std::string(list)};
    for (std::string name; std::getline(words, name, ',');) names.insert(name);
    return names;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + escaped(text) + "`"; }

std::string meaning(const CastOption& option) {
    const std::string_view page = option.see;
    if (page.empty()) return escaped(option.meaning);
    const std::string_view file = page.substr(page.rfind('/') + 1);
    return escaped(option.meaning) + " ([" + std::string(file.substr(0, file.find('.'))) + "](" +
           std::string(page) + "))";
}

std::string option_cell(const CastOption& option) {
    std::string text;
    for (const std::string& name : names_of(option.names)) text = name + (text.empty() ? "" : ", " + text);
    if (const auto at = text.find(", -"); at != std::string::npos && text.starts_with("--"))
        text = text.substr(at + 2) + ", " + text.substr(0, at);
    return code(text + (*option.value ? " " : "") + option.value);
}

std::string tables() {
    std::ostringstream out;
    out << "\n| option | variable | meaning |\n|---|---|---|\n";
    for (const CastOption& option : cast_options)
        if (*option.names)
            out << "| " << option_cell(option) << " | " << code(option.variable) << " | " << meaning(option)
                << " |\n";
    out << "| `--triangles`, `--texture`, ... | | As in `glcast mesh`, when `-o` is a mesh |\n"
        << "\n| variable without option | meaning |\n|---|---|\n";
    for (const CastOption& option : cast_options)
        if (!*option.names)
            out << "| " << code(std::string(option.variable) + "=" + option.value) << " | " << meaning(option)
                << " |\n";
    out << "\n";
    return out.str();
}

/// What --help lists under Options.
std::set<std::string> options_of_help() {
    std::set<std::string> names;
    std::string text;
    if (FILE* pipe = popen(GLCAST_RUN " --help", "r")) {
        std::array<char, 4096> part{};
        while (std::fgets(part.data(), part.size(), pipe)) text += part.data();
        pclose(pipe);
    }
    std::istringstream lines(text.substr(std::min(text.find("Options:\n"), text.size())));
    for (std::string line; std::getline(lines, line) && !line.starts_with("Mesh:");)
        if (line.starts_with("  -")) names.merge(names_of(line.substr(2, line.find(' ', 2) - 2)));
    return names;
}

bool takes_what_the_table_has() {
    std::set<std::string> table{"-h", "--help", "--version"};
    for (const CastOption& option : cast_options) table.merge(names_of(option.names));
    const std::set<std::string> taken = options_of_help();
    for (const std::string& name : table)
        if (!taken.contains(name)) std::cerr << "glcast-run does not take " << name << '\n';
    for (const std::string& name : taken)
        if (!table.contains(name)) std::cerr << "capture/option_table.h has no " << name << '\n';
    return table == taken;
}

/// The one text of the table that another table has too.
bool endings_agree() {
    const bool agree =
        std::string_view(cast_option("--output").meaning).find(listed_mesh_endings()) != std::string::npos;
    if (!agree) std::cerr << "--output of capture/option_table.h names other endings than tools/io writes\n";
    return agree;
}

} // namespace

int main(int count, char** arguments) {
    if (count < 2) {
        std::cerr << "option_page PAGE [--check]\n";
        return 2;
    }
    std::ifstream file(arguments[1]);
    std::ostringstream there;
    there << file.rdbuf();
    const std::string page = there.str();
    const std::size_t start = page.find(first), from = page.find('\n', start) + 1, to = page.find(last);
    if (start == std::string::npos || to == std::string::npos || to < from) {
        std::cerr << arguments[1] << " has no place for the tables\n";
        return 1;
    }
    const std::string made = page.substr(0, from) + tables() + page.substr(to);
    if (count == 2) return std::ofstream(arguments[1]) << made ? 0 : 1;
    if (made != page) std::cerr << arguments[1] << " is stale: run `ninja options`\n";
    return takes_what_the_table_has() && endings_agree() && made == page ? 0 : 1;
}
