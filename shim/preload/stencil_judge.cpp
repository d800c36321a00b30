#include "shim/preload/stencil_judge.h"

#include <algorithm>
#include <map>

#include "capture/engine_target.h"
#include "capture/gl/call_classes.h"
#include "shim/preload/scene_table.h"
#include "shim/preload/scene_thumbnail.h"

namespace glcast::preload {
namespace {

constexpr int picture_size = 256;
constexpr std::size_t most_kinds = 16; ///< of marks that are looked at

/// Of what the draws in question are counted.
enum class Counted { all, before, behind };

using G = GlTable;

/// The program's drawing without its depth test, culling and offsets, which are the judge's.
class JudgeTable {
  public:
    explicit JudgeTable(const GlTable& picture);
    ~JudgeTable() { table_owner<JudgeTable> = nullptr; }
    JudgeTable(const JudgeTable&) = delete;
    JudgeTable& operator=(const JudgeTable&) = delete;

    const GlTable& table() const { return judging; }
    const GlTable& below() const { return inner; }
    bool owns(GLenum cap) const {
        switch (cap) {
        case GL_DEPTH_TEST:
        case GL_CULL_FACE:
        case GL_POLYGON_OFFSET_FILL:
        case GL_BLEND:
        case GL_LIGHTING:
            return true;
        default:
            return false;
        }
    }

  private:
    const GlTable& inner;
    GlTable judging;
};

constexpr OverrideRule rules[] = {
    {always, drop(calls::depth_ranges + calls::offsets + only<&G::DepthFunc, &G::DepthMask>),
     "the judge asks what lies before the marks"},
    {always, drop(only<&G::CullFace, &G::FrontFace, &G::PolygonMode>), "all of every face"},
    {always, drop(calls::queries), "the judge counts pixels"},
    {always, handle<SwitchNotOwned<JudgeTable>>(only<&G::Enable, &G::Disable>),
     "depth, culling, offset, blending and lighting are the judge's"},
    {always, handle<SaveWithout<JudgeTable, GL_DEPTH_BUFFER_BIT | GL_POLYGON_BIT>>(only<&G::PushAttrib>),
     "the judge's state stays as it is"},
};

JudgeTable::JudgeTable(const GlTable& picture) : inner(picture), judging(picture) {
    table_owner<JudgeTable> = this;
    override_calls(judging, inner, rules);
}

/// Lets through marks and the draws in question, and counts these.
class Gate final : public DrawGate {
  public:
    Gate(const GlTable& table, const GlTable& of, bool is_reversed, const std::vector<std::size_t>& marking,
         const std::vector<std::size_t>& asked, Counted what)
        : DrawGate(table), gl(of), reversed(is_reversed), marks(marking), questions(asked), counted(what),
          queries(asked.size()) {
        gl.GenQueries(static_cast<GLsizei>(queries.size()), queries.data());
    }
    ~Gate() override { gl.DeleteQueries(static_cast<GLsizei>(queries.size()), queries.data()); }

    bool keep(GLenum, long) override {
        const std::size_t draw = next++;
        const auto asked = std::find(questions.begin(), questions.end(), draw);
        if (asked != questions.end()) {
            look();
            gl.BeginQuery(GL_SAMPLES_PASSED, queries[static_cast<std::size_t>(asked - questions.begin())]);
            return is_counting = true;
        }
        if (!std::binary_search(marks.begin(), marks.end(), draw)) return false;
        mark();
        return true;
    }
    void drawn() override {
        if (is_counting) gl.EndQuery(GL_SAMPLES_PASSED);
        is_counting = false;
    }

    long count(std::size_t question) const {
        GLuint samples = 0;
        gl.GetQueryObjectuiv(queries[question], GL_QUERY_RESULT, &samples);
        return static_cast<long>(samples);
    }

  private:
    void mark() const {
        gl.DepthMask(GL_TRUE);
        gl.DepthFunc(reversed ? GL_GREATER : GL_LESS);
        gl.Disable(GL_POLYGON_OFFSET_FILL);
        gl.StencilFunc(GL_ALWAYS, 1, ~0u);
        gl.StencilOp(GL_KEEP, GL_REPLACE, GL_REPLACE);
    }

    /// What lies within rounding of a mark is neither before it nor behind it.
    void look() const {
        constexpr float slopes = 1.0f / 16, units = 16;
        gl.DepthMask(GL_FALSE);
        gl.StencilFunc(GL_EQUAL, 1, ~0u);
        gl.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        gl.DepthFunc(GL_ALWAYS);
        if (counted == Counted::all) return;
        const bool is_less = (counted == Counted::before) != reversed;
        gl.DepthFunc(is_less ? GL_LESS : GL_GREATER);
        gl.Enable(GL_POLYGON_OFFSET_FILL);
        gl.PolygonOffset(is_less ? slopes : -slopes, is_less ? units : -units);
    }

    const GlTable& gl;
    const bool reversed;
    const std::vector<std::size_t>& marks;
    const std::vector<std::size_t>& questions;
    const Counted counted;
    std::vector<GLuint> queries;
    std::size_t next = 0;
    bool is_counting = false;
};

void prepare(const GlTable& gl, const Target& target, const Group& group) {
    const PictureSize picture(group.viewport, picture_size);
    target.bind();
    gl.Viewport(0, 0, picture.width, picture.height);
    for (const GLenum cap : {GL_SCISSOR_TEST, GL_CULL_FACE, GL_BLEND, GL_LIGHTING}) gl.Disable(cap);
    for (const GLenum cap : {GL_DEPTH_TEST, GL_STENCIL_TEST}) gl.Enable(cap);
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl.DepthRange(0, 1);
    gl.DepthMask(GL_TRUE);
    gl.StencilMask(~0u);
    gl.ClearDepth(group.depth_reversed ? 0 : 1);
    gl.ClearStencil(0);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

std::vector<long> count(const GlTable& gl, const Target& target, const record::Frame& frame,
                        const Group& group, const std::vector<std::size_t>& marks,
                        const std::vector<std::size_t>& draws, Counted what) {
    prepare(gl, target, group);
    const PictureTable picture(gl);
    const JudgeTable judging(picture.table());
    std::vector<long> counts;
    Gate gate(judging.table(), gl, group.depth_reversed, marks, draws, what);
    record::replay(frame, gated_table(gate));
    for (std::size_t i = 0; i < draws.size(); ++i) counts.push_back(gate.count(i));
    target.bind();
    return counts;
}

/// glvnd has the entry points in any case: the counter tells.
bool can_count(const GlTable& gl) {
    if (!has_framebuffer_calls(gl) || !gl.GenQueries || !gl.BeginQuery || !gl.EndQuery ||
        !gl.GetQueryObjectuiv || !gl.DeleteQueries || !gl.GetQueryiv)
        return false;
    GLint bits = 0;
    gl.GetQueryiv(GL_SAMPLES_PASSED, GL_QUERY_COUNTER_BITS, &bits);
    return bits > 0;
}

} // namespace

constinit const OverrideRules judge_rules = {"A small picture that is counted",
                                             "Whether a draw lies before what marked the stencil buffer",
                                             rules,
                                             {}};

void judge(const GlTable& real, const record::Frame& frame, Scene& scene, int group, StencilPlan& plan) {
    const GlTable gl = with_framebuffer_calls(real);
    if (plan.questions.empty()) return;
    plan.unanswered = static_cast<long>(plan.questions.size());
    if (!can_count(gl)) return;
    std::map<std::vector<std::size_t>, std::vector<const StencilQuestion*>> by_marks;
    for (const StencilQuestion& question : plan.questions) by_marks[question.marks].push_back(&question);
    const Target target(gl, picture_size, false);
    if (!target.complete() || by_marks.size() > most_kinds) return;
    plan.unanswered = 0;
    for (const auto& [marks, questions] : by_marks) {
        std::vector<std::size_t> draws;
        for (const StencilQuestion* question : questions) draws.push_back(question->draw);
        const auto counted = [&](Counted what) {
            return count(gl, target, frame, scene.groups[group], marks, draws, what);
        };
        const auto all = counted(Counted::all), before = counted(Counted::before),
                   behind = counted(Counted::behind);
        for (std::size_t i = 0; i < questions.size(); ++i)
            answer(scene, plan, *questions[i], {all[i], before[i], behind[i]});
    }
    swallow_errors(gl);
}

} // namespace glcast::preload
