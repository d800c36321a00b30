// One run of the pipeline, step by step. Internal.
#pragma once
#include <chrono>

#include "tools/deviation/level_error.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/sized_levels.h"
#include "tools/reconstruct/captured_surface.h"

namespace glcast {

class Run {
  public:
    Run(const PipelineOptions& options, const std::filesystem::path& named)
        : options(options), named(named) {}

    void make_surface(const std::filesystem::path& capture);
    void make_levels(); ///< fitted, finest first, no two alike
    void make_textures();
    void measure();
    void write(const std::filesystem::path& output);
    MeshedCapture take();

  private:
    /// A level on its way, without its texture until make_textures().
    struct Draft {
        Level level;
        Asked asked;
        std::size_t count = 0; ///< that was asked of the search, where it was found by one
        double limit = 0;      ///< of what 99.9 % of it may be off, model units; 0: none
        bool bare = false;     ///< SizedLevel::bare
        std::optional<TextureReport> texture{};
    };

    void stage(const std::string& what) const {
        if (options.stage) options.stage(what);
    }
    void note(const std::string& line) { made.notes.push_back(line); }
    bool is_full(const Level& level) const {
        return level.mesh.triangles.size() == full.mesh.triangles.size();
    }
    Level draft_of(Mesh&& simplified, bool may_move) const;
    Level shaped(Mesh&& simplified, bool may_move) const;
    void colour(Level& level) const;
    void add_full();
    void add_counted();
    void add_sized(const std::vector<double>& pixels);
    void bind_to_progressive_mesh();
    void drop_doubles();
    bool has_textures() const;
    void texture(Draft& draft);
    void measure_drafts(const std::vector<std::size_t>& which);
    std::vector<std::size_t> too_far() const;
    void remove_left_over(const std::filesystem::path& output, const LevelSet& before);

    const PipelineOptions& options;
    const std::filesystem::path named; ///< what levels are named after
    Level full;
    MeshCheck full_check;
    CapturedSurface captured;
    std::unique_ptr<LevelMeter> meter;
    std::unique_ptr<Simplification> simplification;
    std::unique_ptr<LevelSearch> search;
    CollapseLog log; ///< for a progressive mesh: of the run that made the levels
    std::vector<Draft> drafts;
    std::vector<Level> rounded; ///< of drafts, where the files hold rounded ones
    MeshedCapture made;
};

} // namespace glcast
