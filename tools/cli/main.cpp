// glcast: what happens to a capture after it was made. One file a subcommand.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <new>
#include <system_error>

#include "tools/cli/command.h"
#include "tools/cli/interrupt.h"
#include "tools/words/text.h"

namespace {

using namespace glcast::cli;

struct Command {
    const char* name;
    const char* synopsis;
    Run (*declare)(CLI::App& app);
};

constexpr Command commands[] = {
    {"mesh", "make a closed mesh with levels of detail out of a capture", declare_mesh},
    {"info", "say what is in a capture or a mesh, checked", declare_info},
    {"compare", "measure how far two meshes are apart", declare_compare},
    {"refine", "take a level out of a progressive mesh, or something between two", declare_refine},
    {"render", "draw a mesh: six sides and two corners, a row per level", declare_render},
    {"view", "make a page to turn the cast in a browser, its levels and errors beside the captured views",
     declare_view},
};

constexpr int failed = 1, usage = 2;

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

/// What a full disk or a closed pipe took away is not printed, whatever the command says.
bool printed_all() {
    errno = 0;
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return true;
    say(std::string("cannot write to standard output: ") + std::strerror(errno ? errno : EIO));
    return false;
}

/// What a parse error means for the user; help and version are no errors.
int explain(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
        const int status = app.exit(error);
        if (std::cout.flush()) return status;
        say("cannot write to standard output");
        return failed;
    }
    const auto chosen = app.get_subcommands();
    say(one_line(error.what()) + " (see glcast " + (chosen.empty() ? "" : chosen[0]->get_name() + " ") +
        "--help)");
    return usage;
}

/// Numbers that no range refuses: nan is neither below nor above one, and not every option has two ends.
void require_finite(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_type_name().starts_with("FLOAT")) continue;
        for (const std::string& text : option->results())
            if (!std::isfinite(std::strtod(text.c_str(), nullptr)))
                throw CLI::ValidationError(option->get_name(), text + " is no finite number");
    }
}

/// The first word where it is no command: which one was meant, and which there are. Else empty.
std::string no_such_command(int argc, const char* const* argv) {
    const std::string word = argc > 1 ? argv[1] : "";
    std::vector<std::string> names;
    for (const Command& command : commands) names.emplace_back(command.name);
    if (word.empty() || word[0] == '-' || std::find(names.begin(), names.end(), word) != names.end()) return "";
    const std::string meant = glcast::nearest(word, names);
    const std::string which = meant.empty() ? "there are " : "do you mean " + meant + "? There are ";
    return "no such command: " + word + "; " + which + glcast::enumeration(names) + " (see glcast --help)";
}

int run(const Run& command) {
    try {
        const int status = command();
        return printed_all() ? status : failed;
    } catch (const std::bad_alloc&) {
        say("out of memory; a smaller -n in glcast-run needs less");
    } catch (const std::system_error& error) {
        const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
        say(one_line(error.what()) + (no_thread ? ": out of memory or of threads" : ""));
    } catch (const std::exception& error) {
        say(one_line(error.what()));
    }
    return failed;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Closed, coloured meshes out of what an OpenGL program drew. Captures are made by glcast-run.",
        "glcast"};
    app.set_version_flag("--version", "glcast " GLCAST_VERSION);
    app.require_subcommand(1);
    if (const std::string trouble = no_such_command(argc, argv); !trouble.empty()) {
        say(trouble);
        return usage;
    }
    Run chosen;
    for (const Command& command : commands) {
        CLI::App* sub = app.add_subcommand(command.name, command.synopsis);
        sub->callback([&chosen, action = command.declare(*sub)] { chosen = action; });
    }
    std::signal(SIGXFSZ, SIG_IGN); // a write beyond the limit then fails as on a full disk
    try {
        app.parse(argc, argv);
        require_finite(*app.get_subcommands().at(0));
    } catch (const CLI::ParseError& error) {
        return explain(app, error);
    }
    end_cleanly_on_signals();
    return run(chosen);
}
