// What the subcommands share: how they are listed, and how they speak.
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "tools/mesh/check.h"
#include "tools/mesh/level.h"

namespace glcast::cli {

/// Runs a parsed command: the exit status, 0 or 1. Throws std::runtime_error with one line for the user.
using Run = std::function<int()>;

// Each declares its options and gives what to do when they are parsed.
Run declare_mesh(CLI::App& app);
Run declare_info(CLI::App& app);
Run declare_compare(CLI::App& app);
Run declare_render(CLI::App& app);
Run declare_refine(CLI::App& app);
Run declare_view(CLI::App& app);

/// A line to stderr: "glcast: ...", control characters written out.
void say(const std::string& line);

/// What is being done, on a terminal only, gone when done.
class Progress {
  public:
    explicit Progress(const std::string& what);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

  private:
    bool shown;
};

/// A Progress for each step of a run that tells of its steps; "" for none.
std::function<void(const std::string& what)> progress_of_stages();

/// One object on stdout, nothing else.
void print_json(const nlohmann::ordered_json& object);

/// Throws when there is no such file: asked before its kind is guessed from what it holds.
void require_file(const std::string& file);

/// Throws when a file cannot be made at `path`: asked before hours of work, not after.
void require_writable(const std::filesystem::path& path);

/// Throws std::runtime_error for a mesh so large that areas and distances are no numbers any more.
void require_measurable(const Mesh& mesh, const MeshCheck& check);

/// Everything check_mesh counts.
nlohmann::ordered_json to_json(const MeshCheck& check);

/// The measured errors under their names (tools/mesh/error_names.h).
nlohmann::ordered_json to_json(const LevelError& error);

/// The same for people: "mean 0.01 (0.2 samples), 99.9 % ..., max ...; normals 2 degrees; colours mean 0.01, 99.9 % 0.1".
std::string error_line(const LevelError& error, double sample);

/// Offers --normals geometric where drawn normals are far off a good part of the surface, a tenth; else empty.
std::string normals_advice(double disagreeing_normals_share);

/// "1234 triangles, 1851 edges, closed two-manifold"
std::string summary(const MeshCheck& check);

/// A number for people: six digits.
std::string number(double value);

} // namespace glcast::cli
