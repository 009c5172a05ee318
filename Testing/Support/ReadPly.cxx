#include "Support/ReadPly.h"

#include "Support/Errors.h"

#include <cstring>
#include <fstream>
#include <sstream>

namespace dmg::test
{

Surface ReadPly(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::getline(file, line);
  int vertices = 0;
  int faces = 0;
  bool isBinary = false;
  while (line != "end_header" && std::getline(file, line))
  {
    std::istringstream words(line);
    std::string first;
    std::string second;
    int count = 0;
    words >> first >> second >> count;
    isBinary = isBinary || (first == "format" && second == "binary_little_endian");
    if (first == "element")
    {
      (second == "vertex" ? vertices : faces) = count;
    }
  }
  std::vector<float> coordinates(3 * static_cast<std::size_t>(vertices));
  constexpr std::size_t bytesPerFace = 1 + 3 * sizeof(int);
  std::vector<char> corners(bytesPerFace * faces);
  file.read(reinterpret_cast<char*>(coordinates.data()), coordinates.size() * sizeof(float));
  file.read(corners.data(), corners.size());
  if (!isBinary || !file)
  {
    throw InvalidInput(path + " is not a binary little-endian PLY file of triangles");
  }
  Surface surface{ Points(vertices, 3), Triangles(faces, 3) };
  for (std::size_t i = 0; i < coordinates.size(); ++i)
  {
    surface.V.data()[i] = coordinates[i];
  }
  for (int f = 0; f < faces; ++f)
  {
    const char* face = corners.data() + bytesPerFace * f;
    if (face[0] != 3)
    {
      throw InvalidInput(path + ": face " + std::to_string(f) + " is not a triangle");
    }
    std::memcpy(surface.F.data() + 3 * f, face + 1, 3 * sizeof(int));
  }
  return surface;
}

}
