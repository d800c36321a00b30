#include "capture/output_name.h"

namespace glcast {

std::string output_name(const std::string& pattern, long process, long frame) {
    std::string name;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        const char next = pattern[i] == '%' && i + 1 < pattern.size() ? pattern[i + 1] : 0;
        switch (next) {
        case 'p':
            name += std::to_string(process);
            break;
        case 'f':
            name += std::to_string(frame);
            break;
        case '%':
            name += '%';
            break;
        default:
            name += pattern[i];
            continue;
        }
        ++i;
    }
    return name;
}

bool is_pattern(const std::string& name) { return output_name(name, 1, 1) != name; }

} // namespace glcast
