// Compressing what a capture shows, and appending it, on a thread of its own: half of a capture's time is
// compression, which so goes on while the next view is drawn.
#pragma once
#include <pthread.h>

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "capture/exr_compress.h"
#include "capture/output_file.h"
#include "capture/view.h"

namespace glcast {

/// The lines of one chunk.
struct Band {
    int part = 0, first_line = 0, lines = 0;
    /// Where it shows nothing but the background of a side. Its chunk is made once for a number of lines.
    std::optional<Side> blank;
    std::vector<std::vector<float>> planes; ///< as compress_band() takes them
};

/// What all bands have in common.
struct BandFormat {
    int width = 0;
    std::vector<exr::Channel> channels;
    exr::Compression compression = exr::Compression::zip;
};

/// Bands go into the file in the order in which they are given. The thread lives from the first band to
/// drain(), blocks all signals (they are the program's) and touches nothing but the file; where none can be
/// had, put() does its work. All calls from one thread; they throw std::bad_alloc only.
class BandWriter {
  public:
    /// `most` bands are held at a time: next() waits for one.
    BandWriter(OutputFile& file, BandFormat format, int most);
    ~BandWriter();
    BandWriter(const BandWriter&) = delete;
    BandWriter& operator=(const BandWriter&) = delete;

    /// A band to be filled, with planes of the right size and any contents.
    Band next();
    /// False when this band, or one before, has failed.
    bool put(Band&& band);
    /// Waits for all bands and ends the thread. False when one has failed.
    bool drain();

    const std::string& error() const { return message; } ///< after drain(): one line, empty when all is well
    /// After drain(): file offset of each chunk of a part.
    const std::vector<std::uint64_t>& chunks_of(int part) { return chunk_at[part]; }

  private:
    bool start_thread();
    void work();
    void write(Band& band) noexcept;
    void compress(Band& band);
    void append(const exr::Chunk& chunk, int part, int first_line);

    OutputFile& file;
    const BandFormat format;
    const int most;

    // The thread's, and the caller's while there is none.
    std::map<std::pair<Side, int>, exr::Chunk> blank_chunks; ///< by the number of lines
    std::map<int, std::vector<std::uint64_t>> chunk_at;
    std::string message;

    std::mutex mutex; ///< guards the next two lines
    std::vector<Band> waiting, spare;
    bool failed = false, ending = false;
    std::condition_variable changed;

    int made = 0; ///< bands, here or there
    std::optional<pthread_t> thread;
    bool alone = false; ///< no thread can be had
};

} // namespace glcast
