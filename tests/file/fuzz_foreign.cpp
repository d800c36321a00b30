// fuzz_foreign SECONDS SEED: damages files of every kind that readers know, for as long as it is told, and reads them.
// Prints what came of it; any end but 0 is a fault. Meant for a build with -fsanitize=address,undefined.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <sys/resource.h>

#include "tests/file/file_tools.h"
#include "tests/file/foreign_kinds.h"
#include "tools/io/mesh_io.h"

using namespace glcast;
using namespace glcast::samples;
using Clock = std::chrono::steady_clock;

namespace {

std::mt19937_64 random_numbers;

std::size_t below(std::size_t count) { return count ? random_numbers() % count : 0; }

/// One damage of several.
void damage(std::string& text, const std::string& other) {
    static const char* const hostile[] = {"-1", "0", "4294967295", "99999999999", "1e308", "1e-320", "nan", "inf", "1e400", "2147483647",
                                          "3000000", "-", "", "f 1 2 3\n", "end", "\\\n", "#", " ", "\n", "\0"};
    const std::size_t at = below(text.size() + 1), length = below(40);
    switch (below(7)) {
    case 0:
        if (at < text.size()) text[at] = char(random_numbers());
        break;
    case 1:
        text.erase(at, length);
        break;
    case 2:
        text.insert(at, text.substr(below(text.size()), length));
        break;
    case 3:
        text = text.substr(0, at) + other.substr(std::min(other.size(), at));
        break;
    case 4: {
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit == text.npos) break;
        text.replace(digit, text.find_first_not_of("0123456789.", digit) - digit, hostile[below(std::size(hostile))]);
        break;
    }
    case 5:
        text.insert(at, hostile[below(std::size(hostile))]);
        break;
    default:
        text.resize(at);
    }
}

} // namespace

int main(int count, char** words) {
    const double seconds = count > 1 ? std::atof(words[1]) : 10;
    random_numbers.seed(count > 2 ? std::strtoull(words[2], nullptr, 10) : 1);
    const std::vector<foreign::Kind> kinds = foreign::kinds();
    const Folder folder;
    struct Tally {
        long read = 0, refused = 0;
        double slowest = 0;
    };
    std::map<std::string, Tally> tallies;
    std::map<std::string, long> reasons;
    const Clock::time_point start = Clock::now();
    while (std::chrono::duration<double>(Clock::now() - start).count() < seconds) {
        const foreign::Kind& kind = kinds[below(kinds.size())];
        std::string text = kind.text;
        for (std::size_t times = 1 + below(4); times > 0; --times) damage(text, kinds[below(kinds.size())].text);
        std::string ending = kind.file.substr(kind.file.rfind('.'));
        for (char& c : ending) c = char(std::tolower(c));
        write_text(folder / ("x" + ending), text);
        Tally& tally = tallies[ending];
        const Clock::time_point began = Clock::now();
        try {
            read_levels(folder / ("x" + ending));
            ++tally.read;
        } catch (const std::runtime_error& e) {
            ++tally.refused;
            std::string why = e.what();
            if (why.find('\n') != why.npos) return std::puts("a message of two lines"), 1;
            ++reasons[why.substr(why.rfind("': ") + 3, 24)];
        }
        const double took = std::chrono::duration<double>(Clock::now() - began).count();
        if (took > 5) write_text("slow" + ending, text);
        tally.slowest = std::max(tally.slowest, took);
    }
    rusage own{}, children{};
    getrusage(RUSAGE_SELF, &own), getrusage(RUSAGE_CHILDREN, &children);
    for (const auto& [ending, tally] : tallies)
        std::printf("%s: %ld read, %ld refused, slowest %.2f s\n", ending.c_str(), tally.read, tally.refused, tally.slowest);
    for (const auto& [why, times] : reasons)
        if (why.find("crash") != why.npos || why.find("asks for") != why.npos || why.find("too long") != why.npos)
            std::printf("%s: %ld\n", why.c_str(), times);
    std::printf("peak %ld MB, of readers %ld MB\n", own.ru_maxrss / 1024, children.ru_maxrss / 1024);
}
