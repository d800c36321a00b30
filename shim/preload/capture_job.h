// From a plan to files: the capture, what it cannot show, and further views to measure with.
#pragma once
#include <map>
#include <string>

#include "capture/capture_file.h"
#include "shim/preload/capture_plan.h"
#include "shim/preload/cast.h"

namespace glcast::preload {

class CaptureJob {
  public:
    /// `plan` has a box. All must outlive it.
    CaptureJob(FrameReplay& replay, const Options& options, const CastWindow& window, long number,
               const CapturePlan& plan);

    /// Captured, or failed with a line.
    CastResult run();

  private:
    std::map<std::string, long> not_understood() const;
    CaptureInfo make_info() const;
    CastResult write(const DrawFunction& draw, const CaptureInfo& info, const EngineOptions& engine,
                     const std::string& path) const;
    CastResult write_references(CaptureInfo info, const std::string& path, CastResult captured) const;

    FrameReplay& replay;
    const Options& options;
    const CastWindow& window;
    const long number;
    const CapturePlan& plan;
    const Group& group;
};

} // namespace glcast::preload
