// Meshes of captures, made one at a time by `glcast mesh`, while the program may go on.
#pragma once
#include <sys/types.h>

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/run/options.h"
#include "tools/run/process.h"
#include "tools/run/status.h"

namespace glcast::run {

/// `glcast`: beside this program, or in the build tree. Empty when there is none.
std::filesystem::path find_glcast();

/// What the shim is to call captures that become meshes: beside the mesh when they are to be kept, else in
/// `scratch`.
std::filesystem::path capture_pattern(const Options& options, const std::filesystem::path& scratch);

class MeshStep {
  public:
    /// `scratch`: a folder for what is gone at the end.
    MeshStep(const Options& options, std::filesystem::path glcast, std::filesystem::path scratch);

    /// Asks `glcast mesh`, before anything is started, whether it could write the mesh with the options
    /// given: 0, or the exit status, its line in `why`.
    int rehearse(std::string& why) const;

    /// Takes over captures that are new in `seen`. Not while another window may show something better.
    void take(const Seen& seen);
    /// What has ended is noted, and the next mesh begun. `program` knows of our children.
    void advance(Program& program);
    bool busy() const { return running >= 0 || !waiting.empty(); }
    /// Ends what runs; what waits is given up too.
    void give_up();

    struct Result {
        Capture capture; ///< its file: where it is kept, or empty
        std::filesystem::path mesh;
        int status = 0;   ///< of glcast mesh; 0: made
        std::string json; ///< what it printed, with --json
    };
    const std::vector<Result>& results() const { return done; }

  private:
    struct Job {
        Capture capture;
        std::filesystem::path mesh;
    };
    std::vector<std::string> command(const std::filesystem::path& capture,
                                     const std::filesystem::path& mesh) const;
    std::filesystem::path mesh_of(const Capture& capture) const;
    void begin(Program& program);
    void finish(int status);
    void finish(const Job& job, int status, std::string json);
    void let_go(const Job& job) const;

    const Options& options;
    const std::filesystem::path glcast, scratch;
    std::deque<Job> waiting;
    Job current; ///< what is `running`
    std::size_t taken = 0; ///< of the captures in `seen`
    pid_t running = -1;
    int output = -1; ///< what it prints, with --json
    std::vector<Result> done;
};

} // namespace glcast::run
