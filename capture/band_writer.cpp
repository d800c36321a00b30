#include "capture/band_writer.h"

#include <signal.h>

#include <exception>

#include "capture/exr_header.h"

namespace glcast {

BandWriter::BandWriter(OutputFile& file, BandFormat format, int most)
    : file(file), format(std::move(format)), most(most) {
    waiting.reserve(std::size_t(most));
    spare.reserve(std::size_t(most)); // so that handing over never allocates
}

BandWriter::~BandWriter() { drain(); }

Band BandWriter::next() {
    std::unique_lock lock(mutex);
    if (spare.empty() && made == most) changed.wait(lock, [&] { return !spare.empty(); });
    if (!spare.empty()) {
        Band band = std::move(spare.back());
        spare.pop_back();
        return band;
    }
    lock.unlock();
    const std::size_t pixels =
        std::size_t(exr::lines_per_chunk(format.compression)) * std::size_t(format.width);
    Band band;
    band.planes.assign(format.channels.size(), std::vector<float>(pixels));
    ++made;
    return band;
}

bool BandWriter::put(Band&& band) {
    if (!thread && !alone) alone = !start_thread();
    if (alone) write(band);
    const std::lock_guard lock(mutex);
    (alone ? spare : waiting).push_back(std::move(band));
    changed.notify_all();
    return !failed;
}

bool BandWriter::drain() {
    if (thread) {
        {
            const std::lock_guard lock(mutex);
            ending = true;
            changed.notify_all();
        }
        pthread_join(*thread, nullptr);
        thread.reset();
        alone = true;
    }
    return !failed;
}

bool BandWriter::start_thread() {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    pthread_t started;
    const auto run = [](void* self) -> void* {
        static_cast<BandWriter*>(self)->work();
        return nullptr;
    };
    const bool done = pthread_create(&started, nullptr, run, this) == 0;
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (done) thread = started;
    return done;
}

void BandWriter::work() {
    std::unique_lock lock(mutex);
    for (;;) {
        changed.wait(lock, [&] { return ending || !waiting.empty(); });
        if (waiting.empty()) return;
        Band band = std::move(waiting.front());
        waiting.erase(waiting.begin());
        lock.unlock();
        write(band);
        lock.lock();
        spare.push_back(std::move(band));
        changed.notify_all();
    }
}

/// After a failure nothing more is written. Only whoever writes sets `failed`, so reading it here needs no
/// lock.
void BandWriter::write(Band& band) noexcept {
    if (failed) return;
    try {
        compress(band);
    } catch (const std::exception& error) {
        message = error.what(); // short: no allocation
    }
    if (message.empty()) return;
    const std::lock_guard lock(mutex);
    failed = true;
}

void BandWriter::compress(Band& band) {
    exr::Chunk* const as_before = band.blank ? &blank_chunks[{*band.blank, band.lines}] : nullptr;
    if (as_before && !as_before->bytes.empty()) return append(*as_before, band.part, band.first_line);
    std::vector<exr::Chunk> chunks;
    if (!exr::compress_band(format.channels, band.planes, format.width, band.lines, band.first_line,
                            format.compression, chunks, message))
        return;
    for (const exr::Chunk& chunk : chunks) append(chunk, band.part, chunk.first_line);
    if (as_before) *as_before = std::move(chunks.front());
}

void BandWriter::append(const exr::Chunk& chunk, int part, int first_line) {
    chunk_at[part].push_back(file.position());
    exr::Bytes head;
    head.u32(static_cast<std::uint32_t>(part));
    head.u32(static_cast<std::uint32_t>(first_line));
    head.u32(static_cast<std::uint32_t>(chunk.bytes.size()));
    if (!file.append(head.data.data(), head.data.size()) ||
        !file.append(chunk.bytes.data(), chunk.bytes.size()))
        message = file.error();
}

} // namespace glcast
