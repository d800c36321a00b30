#include "tests/real/cast_program.h"

#include <filesystem>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "tests/real/command.h"
#include "tools/io/mesh_io.h"
#include "tools/mesh/intersections.h"

namespace glcast::test {
namespace {
namespace fs = std::filesystem;

constexpr double capture_limit_seconds = 150, tool_limit_seconds = 120;

/// Runs a step; the error names it and holds the end of what it said.
bool step(const std::vector<std::string>& command, double limit, std::string& error,
          std::string* out = nullptr,
          const std::vector<std::pair<std::string, std::string>>& environment = {}) {
    const CommandResult result = run_command(command, limit, environment);
    if (out != nullptr) {
        *out = result.out;
    }
    if (result.exit_code == 0 && !result.timed_out) {
        return true;
    }
    for (const std::string& word : command) {
        error += word + " ";
    }
    error += result.timed_out ? "took too long\n" : "ended with " + std::to_string(result.exit_code) + "\n";
    error += result.out + result.err;
    return false;
}

std::vector<std::string> capture_command(const RealProgram& program, const fs::path& capture) {
    std::vector<std::string> command = {GLCAST_RUN, "--headless", "--quit", "-n", std::to_string(program.n),
                                        "-o",       capture};
    command.insert(command.end(), program.options.begin(), program.options.end());
    command.push_back("--");
    command.insert(command.end(), program.command.begin(), program.command.end());
    return command;
}

} // namespace

Cast cast_program(const RealProgram& program) {
    const fs::path folder = REAL_OUTPUT;
    fs::create_directories(folder);
    const fs::path capture = folder / (program.name + ".exr"), mesh = folder / (program.name + ".glb");
    const fs::path plain = folder / (program.name + ".off"), picture = folder / (program.name + ".png");
    for (const fs::path& file : {capture, mesh, plain, picture}) {
        fs::remove(file);
    }
    Cast cast;
    cast.name = program.name;
    auto environment = program.environment;
    environment.emplace_back("PATH", std::string("/usr/bin:") + std::getenv("PATH"));
    std::vector<std::string> make_mesh = {GLCAST, "mesh", capture, "-o", mesh, "--full", "--texture", "none"};
    if (program.levels) {
        make_mesh.insert(make_mesh.end(), {"--ratio", "0.1,0.01"});
    }
    if (!step(capture_command(program, capture), capture_limit_seconds, cast.error, nullptr, environment) ||
        !step(make_mesh, tool_limit_seconds, cast.error) ||
        !step({GLCAST, "mesh", capture, "-o", plain, "--full"}, tool_limit_seconds, cast.error) ||
        !step({GLCAST, "render", mesh, "-o", picture}, tool_limit_seconds, cast.error)) {
        return cast;
    }
    std::string complaints;
    cast.manifold = step({MESH_ORACLE, plain}, tool_limit_seconds, complaints, &cast.oracle);
    cast.oracle += complaints;
    cast.mesh = read_mesh(mesh);
    cast.self_intersections = count_self_intersections(cast.mesh.positions, cast.mesh.triangles);
    return cast;
}

Accuracy accuracy(const Cast& cast, const Mesh& truth) {
    const fs::path original = fs::path(REAL_OUTPUT) / (cast.name + "-truth.off");
    Level level;
    level.mesh = truth;
    write_levels(original, {&level, 1});
    Accuracy measured;
    std::string json;
    if (step({GLCAST, "compare", "--json", original, fs::path(REAL_OUTPUT) / (cast.name + ".glb")},
             tool_limit_seconds, measured.error, &json)) {
        const auto distances = nlohmann::json::parse(json);
        measured.sample = distances.at("sample");
        measured.worst_from_truth = distances.at("aToB").at("samples").at("p999");
        measured.worst_to_truth = distances.at("bToA").at("samples").at("p999");
        measured.from_truth = distances.at("aToB").at("samples").at("mean");
        measured.to_truth = distances.at("bToA").at("samples").at("mean");
    }
    return measured;
}

double area_share(const Mesh& mesh, const glm::vec3& colour) {
    double near = 0, all = 0;
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
        const double area = glm::length(glm::cross(b - a, c - a));
        const glm::vec3 mean = (mesh.colours[t[0]] + mesh.colours[t[1]] + mesh.colours[t[2]]) / 3.0f;
        const float length = glm::length(mean) * glm::length(colour);
        near += length > 0 && glm::dot(mean, colour) > 0.95f * length ? area : 0;
        all += area;
    }
    return all > 0 ? near / all : 0;
}

} // namespace glcast::test
