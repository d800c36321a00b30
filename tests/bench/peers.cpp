#include "tests/bench/peers.h"

#include <sys/resource.h>

#include <chrono>
#include <fstream>
#include <string>

#ifdef GLCAST_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>
#endif
#ifdef GLCAST_VTK
#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#endif

#include <cstring>

namespace glcast::test {
namespace {

#if defined(GLCAST_OPENVDB) || defined(GLCAST_VTK)
double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double resident() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1024;
    return 0;
}
#endif

#ifdef GLCAST_OPENVDB
/// Inside -1/2, outside +1/2; where all around is outside there are no voxels.
PeerResult by_openvdb(const std::vector<unsigned char>& volume, int n, const std::function<void()>& ready) {
    openvdb::initialize();
    auto grid = openvdb::FloatGrid::create(0.5f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    {
        openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(openvdb::Coord(n, n, n));
        for (std::size_t i = 0; i < volume.size(); ++i) dense.data()[i] = volume[i] ? -0.5f : 0.5f;
        openvdb::tools::copyFromDense(dense, *grid, 0.0f);
    }
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec4I> quads;
    ready();
    PeerResult result;
    result.resident_before = resident();
    const double start = now(), cpu = test::cpu_seconds();
    openvdb::tools::volumeToMesh(*grid, points, quads, 0.0);
    result.seconds = now() - start;
    result.cpu_seconds = test::cpu_seconds() - cpu;
    result.triangles = 2 * quads.size();
    return result;
}
#endif

#ifdef GLCAST_VTK
PeerResult by_vtk(const std::vector<unsigned char>& volume, int n, const std::function<void()>& ready) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(n, n, n);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    std::memcpy(image->GetScalarPointer(), volume.data(), volume.size());
    vtkNew<vtkFlyingEdges3D> filter;
    filter->SetInputData(image);
    filter->SetValue(0, 0.5);
    filter->ComputeNormalsOff();
    filter->ComputeGradientsOff();
    filter->ComputeScalarsOff();
    ready();
    PeerResult result;
    result.resident_before = resident();
    const double start = now(), cpu = test::cpu_seconds();
    filter->Update();
    result.seconds = now() - start;
    result.cpu_seconds = test::cpu_seconds() - cpu;
    result.triangles = std::size_t(filter->GetOutput()->GetNumberOfPolys());
    return result;
}
#endif

} // namespace

double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

const std::vector<Peer>& peers() {
    static const std::vector<Peer> all = {
#ifdef GLCAST_OPENVDB
        {"OpenVDB volumeToMesh", by_openvdb},
#endif
#ifdef GLCAST_VTK
        {"VTK flying edges", by_vtk},
#endif
    };
    return all;
}

} // namespace glcast::test
