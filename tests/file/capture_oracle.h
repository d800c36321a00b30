// What the tests of capture files share; OpenEXR, which reads and writes them without us, is the oracle.
#pragma once
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "tools/io/capture_reader.h"

namespace glcast::samples {

/// The file as OpenEXR itself reads it and writes it again.
inline void rewrite_by_openexr(const std::filesystem::path& from, const std::filesystem::path& to,
                               Imf::Compression compression) {
    Imf::MultiPartInputFile in(from.c_str());
    std::vector<Imf::Header> headers;
    for (int part = 0; part < in.parts(); ++part) {
        headers.push_back(in.header(part));
        headers.back().compression() = compression;
        headers.back().erase("chunkCount"); // OpenEXR counts them
    }
    Imf::MultiPartOutputFile out(to.c_str(), headers.data(), int(headers.size()));
    for (int part = 0; part < in.parts(); ++part) {
        const int n = headers[part].dataWindow().max.x + 1;
        std::vector<std::vector<char>> planes;
        Imf::FrameBuffer buffer;
        const Imf::ChannelList& channels = headers[part].channels();
        for (auto c = channels.begin(); c != channels.end(); ++c) {
            const std::size_t bytes = c.channel().type == Imf::HALF ? 2 : 4;
            planes.emplace_back(std::size_t(n) * n * bytes);
            buffer.insert(c.name(), Imf::Slice(c.channel().type, planes.back().data(), bytes, bytes * n));
        }
        Imf::InputPart source(in, part);
        source.setFrameBuffer(buffer);
        source.readPixels(0, n - 1);
        Imf::OutputPart target(out, part);
        target.setFrameBuffer(buffer);
        target.writePixels(n);
    }
}

inline const ViewImage& view_of(const Capture& capture, const View& view) {
    for (const ViewImage& image : capture.images)
        if (image.view == view) return image;
    throw std::logic_error("no such view");
}

inline double angle_degrees(glm::vec3 a, glm::vec3 b) {
    return std::atan2(glm::length(glm::cross(glm::dvec3(a), glm::dvec3(b))),
                      glm::dot(glm::dvec3(a), glm::dvec3(b))) *
           180 / M_PI;
}

inline std::string why_refused(const std::filesystem::path& path) {
    try {
        read_capture(path);
    } catch (const std::runtime_error& e) {
        const std::string why = e.what();
        EXPECT_EQ(why.find('\n'), std::string::npos) << "one line: " << why;
        EXPECT_NE(why.find(path.string()), std::string::npos) << "names the file: " << why;
        return why;
    }
    return "";
}

} // namespace glcast::samples
