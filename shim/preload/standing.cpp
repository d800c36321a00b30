#include "shim/preload/standing.h"

#include <algorithm>

#include "shim/record/frame_contents.h"

namespace glcast::preload {
namespace {

using namespace std::chrono_literals;

/// Between the ends of two frames: of a program that draws seldom; after which a burst of so many may follow,
/// as while somebody turns the model; after which nothing new is to come soon.
constexpr auto seldom = 100ms, rest = 1000ms, still = 300ms;
constexpr long burst = 300;

constexpr std::size_t most_pictures = 8;

} // namespace

void Pace::frame_ended(Clock::time_point now) {
    const auto interval = ended++ == 0 ? Clock::duration::zero() : now - last_end;
    last_end = now;
    left = std::max(left - 1, interval >= rest ? burst : interval >= seldom ? 1 : 0);
}

bool Pace::is_still(Clock::time_point now) const { return ended == 0 || now - last_end >= still; }

StandingPicture make_standing_picture(std::vector<FramePart> parts, FrameKey window, long number) {
    StandingPicture picture{std::move(parts), window, number};
    bool clears = false, shows_images = false;
    for (const FramePart& part : picture.parts) {
        const record::FrameContents contents = record::contents_of(*part.frame);
        picture.draws |= part.draws > 0;
        picture.filled += contents.filled;
        clears |= contents.clears, shows_images |= contents.shows_images;
        picture.bytes += record::frame_bytes(*part.frame);
    }
    picture.hides = clears && !shows_images;
    return picture;
}

void StandingPictures::show(StandingPicture picture, std::size_t most_bytes) {
    std::erase_if(pictures, [&](const StandingPicture& other) {
        return other.window.second == picture.window.second &&
               (picture.hides || (picture.draws && other.filled <= picture.filled));
    });
    if (!picture.draws) return;
    pictures.push_back(std::move(picture));
    std::size_t bytes = 0;
    for (const StandingPicture& each : pictures) bytes += each.bytes;
    while (!pictures.empty() && (bytes > most_bytes || pictures.size() > most_pictures)) {
        bytes -= pictures.front().bytes;
        pictures.erase(pictures.begin());
    }
}

void StandingPictures::show_unseen(std::uintptr_t drawable) {
    for (StandingPicture& picture : pictures) picture.unseen += picture.window.second == drawable;
}

void StandingPictures::forget_display(const void* display) {
    std::erase_if(pictures, [&](const StandingPicture& picture) {
        return std::any_of(picture.parts.begin(), picture.parts.end(),
                           [&](const FramePart& part) { return part.context->display == display; });
    });
}

void StandingPictures::forget_frame(FrameKey window, long number) {
    std::erase_if(pictures, [&](const StandingPicture& picture) {
        return picture.window == window && picture.number == number;
    });
}

} // namespace glcast::preload
