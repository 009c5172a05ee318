#ifndef dmgQuadriFlowPeer_h
#define dmgQuadriFlowPeer_h

#include "Support/Errors.h"
#include "Support/Types.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <unistd.h>

namespace dmg::peers
{

/// What came of Blender's QuadriFlow (Huang et al. 2018).
struct QuadriFlowMesh
{
  std::string Version;    ///< of Blender
  double Seconds = 0.0;   ///< processor seconds of the operator alone
  double Megabytes = 0.0; ///< of the whole process at its peak, less those before the operator
  Points Positions;
  std::vector<std::array<int, 4>> Quads;
};

/// Runs Blender without a window in a process of its own, by QuadriFlow.py, with the settings that its dialogue begins with, but that the boundary is kept.
/// \param path a PLY file.
/// \return none where Blender is not on PATH.
/// \throw SolverFailure there are no quads.
inline std::optional<QuadriFlowMesh> MakeQuadsByQuadriFlow(const std::string& path, double number)
{
  if (std::system("command -v blender > /dev/null 2>&1") != 0)
  {
    return {};
  }
  const std::filesystem::path folder =
    std::filesystem::temp_directory_path() / ("quadriflow" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string result = (folder / "quads.txt").string();
  const std::string command = "blender -b --python-exit-code 1 --python '" DMG_PEERS_FOLDER "/QuadriFlow.py' -- '" +
    path + "' " + std::to_string(static_cast<long long>(number)) + " '" + result + "' > /dev/null 2>&1";
  const int failure = std::system(command.c_str());
  QuadriFlowMesh mesh;
  std::ifstream file(result);
  int vertices = 0, quads = 0;
  if (failure == 0 && file >> mesh.Version >> mesh.Seconds >> mesh.Megabytes >> vertices >> quads)
  {
    mesh.Positions.resize(vertices, 3);
    mesh.Quads.resize(quads);
    for (double& coordinate : mesh.Positions.reshaped<Eigen::RowMajor>())
    {
      file >> coordinate;
    }
    for (auto& quad : mesh.Quads)
    {
      file >> quad[0] >> quad[1] >> quad[2] >> quad[3];
    }
  }
  const bool isRead = failure == 0 && !file.fail() && quads > 0;
  std::filesystem::remove_all(folder);
  if (!isRead)
  {
    throw SolverFailure("no quads");
  }
  return mesh;
}

}

#endif
