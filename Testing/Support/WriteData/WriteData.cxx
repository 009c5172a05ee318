/// Writes the meshes of the folder Data: WriteData FOLDER.
///
/// Numbers are rounded to 1e-6, so that every platform writes the same files.

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/MeshFactory.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace dmg;
using namespace dmg::test;

/// A direction to prescribe on the face nearest to a point.
struct Wish
{
  Vector3 Where;
  Vector3 Direction;
};

/// In steps of 1e-6, without a negative zero.
double Rounded(double x)
{
  return std::round(1e6 * x) / 1e6 + 0.0;
}

int NearestFace(const TriangleMesh& mesh, const Vector3& where)
{
  int nearest = 0;
  double least = HUGE_VAL;
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    const Vector3 centre =
      (mesh.Position(mesh.Tail(3 * f)) + mesh.Position(mesh.Tail(3 * f + 1)) + mesh.Position(mesh.Tail(3 * f + 2))) /
      3.0;
    // A millionth of a difference decides for the smaller number, as on every platform.
    if ((centre - where).squaredNorm() < least - 1e-6)
    {
      least = (centre - where).squaredNorm();
      nearest = f;
    }
  }
  return nearest;
}

template <class Range>
void WriteArray(std::ostream& out, const char* type, const char* name, int components, const Range& numbers)
{
  out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
      << "\" format=\"ascii\">\n";
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    out << numbers[i] << ((i + 1) % 12 == 0 || i + 1 == numbers.size() ? '\n' : ' ');
  }
  out << "</DataArray>\n";
}

std::vector<double> RoundedRows(const Points& points)
{
  std::vector<double> numbers;
  for (int i = 0; i < points.size(); ++i)
  {
    numbers.push_back(Rounded(points.data()[i]));
  }
  return numbers;
}

/// A VTK XML surface with the cell arrays Mask and Directions.
void Write(const std::string& path, const Surface& surface, const std::vector<Wish>& wishes)
{
  const TriangleMesh mesh = surface.Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  std::vector<int> mask(mesh.NumberOfFaces(), 0);
  Points directions = Points::Zero(mesh.NumberOfFaces(), 3);
  for (const Wish& wish : wishes)
  {
    const int face = NearestFace(mesh, wish.Where);
    const Complex tangential = frames.ToComplex(face, wish.Direction);
    mask[face] = 1;
    directions.row(face) = frames.ToVector(face, tangential / std::abs(tangential)).transpose();
  }
  std::vector<int> corners;
  std::vector<int> offsets;
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    for (int h = 3 * f; h < 3 * f + 3; ++h)
    {
      corners.push_back(mesh.Tail(h));
    }
    offsets.push_back(3 * (f + 1));
  }

  std::ofstream out(path, std::ios::binary);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\">\n<PolyData>\n"
      << "<Piece NumberOfPoints=\"" << mesh.NumberOfVertices() << "\" NumberOfPolys=\"" << mesh.NumberOfFaces()
      << "\">\n<CellData>\n";
  WriteArray(out, "UInt8", "Mask", 1, mask);
  WriteArray(out, "Float32", "Directions", 3, RoundedRows(directions));
  out << "</CellData>\n<Points>\n";
  WriteArray(out, "Float32", "Points", 3, RoundedRows(mesh.VertexPositions()));
  out << "</Points>\n<Polys>\n";
  WriteArray(out, "Int32", "connectivity", 1, corners);
  WriteArray(out, "Int32", "offsets", 1, offsets);
  out << "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  if (!out.flush())
  {
    throw std::runtime_error("cannot write " + path);
  }

  std::cout << path << ": #V " << mesh.NumberOfVertices() << ", #F " << mesh.NumberOfFaces()
            << ", Euler characteristic " << mesh.EulerCharacteristic() << '\n';
}

}

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: " << argv[0] << " FOLDER\n";
    return EXIT_FAILURE;
  }
  const std::string folder = std::string(argv[1]) + '/';
  const Vector3 x = Vector3::UnitX();
  const Vector3 y = Vector3::UnitY();
  const Vector3 z = Vector3::UnitZ();
  try
  {
    Write(folder + "sphere.vtp", IrregularSphere(3, 1), { { x, y + z }, { -x, y }, { y, z } });
    Write(folder + "torus.vtp", IrregularTorus(48, 20, 2),
      { { 1.4 * x, z }, { -1.4 * x, y + 0.3 * z }, { Vector3(0.0, 1.0, 0.4), x } });
    Write(folder + "double_torus.vtp", DoubleTorus(4),
      { { Vector3(0.3, 1.5, 1.0), x + y }, { Vector3(2.5, 1.5, 1.0), x }, { Vector3(4.7, 1.5, 0.0), y } });

    // Along the boundary of the disc all around, and radial at a point near its centre.
    std::vector<Wish> wishes = { { 0.1 * x, x } };
    for (int i = 0; i < 72; ++i)
    {
      const double angle = (i + 0.5) * 2.0 * std::acos(-1.0) / 72;
      wishes.push_back({ { std::cos(angle), std::sin(angle), 0.0 }, { -std::sin(angle), std::cos(angle), 0.0 } });
    }
    Write(folder + "disk.vtp", Disk(12), wishes);
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
