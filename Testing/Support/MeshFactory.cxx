#include "Support/MeshFactory.h"

#include "Support/Random.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace dmg::test
{

namespace
{

/// Collects points and triangles.
class Builder
{
public:
  int AddPoint(double x, double y, double z)
  {
    this->Points_.emplace_back(x, y, z);
    return static_cast<int>(this->Points_.size()) - 1;
  }
  int AddPoint(const Vector3& p) { return this->AddPoint(p.x(), p.y(), p.z()); }

  void AddTriangle(int a, int b, int c) { this->Corners.push_back({ a, b, c }); }

  /// Corners counter-clockwise from \p a; cut from a to c, or from b to d.
  void AddQuad(int a, int b, int c, int d, bool cutsOther = false)
  {
    if (cutsOther)
    {
      this->AddTriangle(a, b, d);
      this->AddTriangle(b, c, d);
    }
    else
    {
      this->AddTriangle(a, b, c);
      this->AddTriangle(a, c, d);
    }
  }

  Surface Build() const
  {
    Surface surface{ Points(this->Points_.size(), 3), Triangles(this->Corners.size(), 3) };
    for (std::size_t i = 0; i < this->Points_.size(); ++i)
    {
      surface.V.row(i) = this->Points_[i].transpose();
    }
    for (std::size_t f = 0; f < this->Corners.size(); ++f)
    {
      surface.F.row(f) << this->Corners[f][0], this->Corners[f][1], this->Corners[f][2];
    }
    return surface;
  }

private:
  std::vector<Vector3> Points_;
  std::vector<std::array<int, 3>> Corners;
};

/// Points (i, j), i along columns. \p place gives a point's position, \p cutsOther a square's
/// diagonal.
template <class Place, class Cut>
Surface Grid(int columns, int rows, const Place& place, const Cut& cutsOther)
{
  Builder builder;
  for (int j = 0; j <= rows; ++j)
  {
    for (int i = 0; i <= columns; ++i)
    {
      builder.AddPoint(place(i, j));
    }
  }
  const auto at = [columns](int i, int j) { return j * (columns + 1) + i; };
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      builder.AddQuad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), cutsOther(i, j));
    }
  }
  return builder.Build();
}

/// As Grid, closed along columns and, if \p closesRows, along rows.
template <class Place, class Cut>
Surface ClosedGrid(int columns, int rows, bool closesRows, const Place& place, const Cut& cutsOther)
{
  Builder builder;
  const int numberOfRows = closesRows ? rows : rows + 1;
  for (int j = 0; j < numberOfRows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      builder.AddPoint(place(i, j));
    }
  }
  const auto at = [=](int i, int j) { return (j % numberOfRows) * columns + i % columns; };
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      builder.AddQuad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), cutsOther(i, j));
    }
  }
  return builder.Build();
}

bool Never(int, int)
{
  return false;
}

Vector3 TorusPoint(double u, double v, double major, double minor)
{
  const double radius = major + minor * std::cos(v);
  return { radius * std::cos(u), radius * std::sin(u), minor * std::sin(v) };
}

void Normalise(Points& V)
{
  V.rowwise().normalize();
}

Surface Icosahedron()
{
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  Surface surface{ Points(12, 3), Triangles(20, 3) };
  surface.V << -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0, 0, -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, g, 0, -1, g, 0, 1, -g, 0,
    -1, -g, 0, 1;
  surface.F << 0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3, 9,
    4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1;
  Normalise(surface.V);
  return surface;
}

/// The boundary of a set of unit cubes. No two of them may touch along an edge or corner only.
Surface BoundaryOfCubes(const std::array<int, 3>& size, const std::vector<char>& filled)
{
  const auto isFilled = [&](std::array<int, 3> cell)
  {
    for (int k = 0; k < 3; ++k)
    {
      if (cell[k] < 0 || cell[k] >= size[k])
      {
        return false;
      }
    }
    return filled[(cell[2] * size[1] + cell[1]) * size[0] + cell[0]] != 0;
  };

  Builder builder;
  std::map<std::array<int, 3>, int> points;
  const auto pointAt = [&](const std::array<int, 3>& p)
  {
    const auto [entry, isNew] = points.emplace(p, 0);
    if (isNew)
    {
      entry->second = builder.AddPoint(p[0], p[1], p[2]);
    }
    return entry->second;
  };

  std::array<int, 3> cell;
  for (cell[2] = 0; cell[2] < size[2]; ++cell[2])
  {
    for (cell[1] = 0; cell[1] < size[1]; ++cell[1])
    {
      for (cell[0] = 0; cell[0] < size[0]; ++cell[0])
      {
        if (!isFilled(cell))
        {
          continue;
        }
        for (int axis = 0; axis < 3; ++axis)
        {
          const int u = (axis + 1) % 3;
          const int v = (axis + 2) % 3;
          for (int side = 0; side < 2; ++side)
          {
            std::array<int, 3> neighbour = cell;
            neighbour[axis] += side == 0 ? -1 : 1;
            if (isFilled(neighbour))
            {
              continue;
            }
            std::array<int, 3> corner = cell;
            corner[axis] += side;
            const int a = pointAt(corner);
            ++corner[u];
            const int b = pointAt(corner);
            ++corner[v];
            const int c = pointAt(corner);
            --corner[u];
            const int d = pointAt(corner);
            const bool cutsOther = (cell[0] + cell[1] + cell[2]) % 2 != 0;
            if (side == 1)
            {
              builder.AddQuad(a, b, c, d, cutsOther);
            }
            else
            {
              builder.AddQuad(a, d, c, b, cutsOther);
            }
          }
        }
      }
    }
  }
  return builder.Build();
}

/// Moves every point to the mean of its neighbours.
void SmoothOnce(Surface& surface)
{
  Points sums = Points::Zero(surface.V.rows(), 3);
  std::vector<int> counts(surface.V.rows(), 0);
  for (int f = 0; f < surface.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int a = surface.F(f, k);
      const int b = surface.F(f, (k + 1) % 3);
      sums.row(a) += surface.V.row(b);
      ++counts[a];
    }
  }
  for (int v = 0; v < surface.V.rows(); ++v)
  {
    surface.V.row(v) = sums.row(v) / counts[v];
  }
}

}

Surface PlaneGrid(int columns, int rows)
{
  return Grid(
    columns, rows, [](int i, int j) { return Vector3(i, j, 0.0); }, Never);
}

Surface IrregularPlane(int columns, int rows, unsigned seed, double amount)
{
  Random random(seed);
  return Grid(
    columns, rows,
    [&](int i, int j)
    {
      const bool isInner = i > 0 && i < columns && j > 0 && j < rows;
      const double x = random.Uniform(-amount, amount);
      const double y = random.Uniform(-amount, amount);
      return isInner ? Vector3(i + x, j + y, 0.0) : Vector3(i, j, 0.0);
    },
    [&](int, int) { return random.Uniform() < 0.5; });
}

Surface PlaneWithThinTriangles(int columns, int rows)
{
  Surface surface = IrregularPlane(columns, rows, 4);
  for (int v = 0; v < surface.V.rows(); ++v)
  {
    const double x = surface.V(v, 0);
    surface.V(v, 0) = x - 0.99 * std::clamp(x - columns / 2, 0.0, 1.0);
  }
  return surface;
}

Surface Strip(const std::vector<double>& widths)
{
  const auto columns = static_cast<int>(widths.size());
  Surface strip{ Points(2 * (columns + 1), 3), Triangles(2 * columns, 3) };
  double x = 0.0;
  for (int i = 0; i <= columns; ++i)
  {
    strip.V.row(2 * i) << x, 0.0, 0.0;
    strip.V.row(2 * i + 1) << x, 1.0, 0.0;
    x += i < columns ? widths[i] : 0.0;
  }
  for (int i = 0; i < columns; ++i)
  {
    strip.F.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 1;
    strip.F.row(2 * i + 1) << 2 * i + 2, 2 * i + 3, 2 * i + 1;
  }
  return strip;
}

Surface Disk(int rings)
{
  Builder builder;
  builder.AddPoint(0.0, 0.0, 0.0);
  for (int ring = 1; ring <= rings; ++ring)
  {
    for (int i = 0; i < 6 * ring; ++i)
    {
      const double angle = 2.0 * Pi * i / (6 * ring);
      const double radius = static_cast<double>(ring) / rings;
      builder.AddPoint(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
  }
  // Ring r starts after 1 + 6 (1 + ... + (r - 1)) points; its sector s after another s r.
  const auto at = [](int ring, int i) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + i % (6 * ring); };
  for (int ring = 1; ring <= rings; ++ring)
  {
    for (int sector = 0; sector < 6; ++sector)
    {
      for (int i = 0; i < ring; ++i)
      {
        const int outer = sector * ring + i;
        const int inner = sector * (ring - 1) + i;
        builder.AddTriangle(at(ring - 1, inner), at(ring, outer), at(ring, outer + 1));
        if (i + 1 < ring)
        {
          builder.AddTriangle(at(ring - 1, inner), at(ring, outer + 1), at(ring - 1, inner + 1));
        }
      }
    }
  }
  return builder.Build();
}

Surface Annulus(int around, int rings)
{
  return ClosedGrid(
    around, rings, false,
    [=](int i, int j)
    {
      const double angle = -2.0 * Pi * i / around; // clockwise, as rows go outwards
      const double radius = 1.0 + static_cast<double>(j) / rings;
      return Vector3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    },
    Never);
}

Surface Icosphere(int subdivisions)
{
  Surface surface = Icosahedron();
  for (int s = 0; s < subdivisions; ++s)
  {
    surface = Subdivide(surface);
    Normalise(surface.V);
  }
  return surface;
}

Surface IrregularSphere(int subdivisions, unsigned seed, double amount)
{
  Surface surface = Icosphere(subdivisions);
  const double length = amount * std::sqrt(4.0 * Pi / surface.V.rows());
  Random random(seed);
  for (int v = 0; v < surface.V.rows(); ++v)
  {
    for (int k = 0; k < 3; ++k)
    {
      surface.V(v, k) += random.Uniform(-length, length);
    }
  }
  Normalise(surface.V);
  return surface;
}

Surface Torus(int around, int across, double major, double minor)
{
  return ClosedGrid(
    around, across, true,
    [=](int i, int j) { return TorusPoint(2.0 * Pi * i / around, 2.0 * Pi * j / across, major, minor); }, Never);
}

Surface IrregularTorus(int around, int across, unsigned seed, double major, double minor)
{
  Random random(seed);
  return ClosedGrid(
    around, across, true,
    [&](int i, int j)
    {
      const double u = i + random.Uniform(-0.25, 0.25);
      const double v = j + random.Uniform(-0.25, 0.25);
      return TorusPoint(2.0 * Pi * u / around, 2.0 * Pi * v / across, major, minor);
    },
    [&](int, int) { return random.Uniform() < 0.5; });
}

Surface PerforatedSlab(int columns, int rows, int resolution)
{
  // Blocks of which every second of every second row is left out.
  const int r = resolution;
  const std::array<int, 3> size = { (2 * columns + 1) * r, (2 * rows + 1) * r, r };
  std::vector<char> filled;
  for (int z = 0; z < size[2]; ++z)
  {
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        filled.push_back(x / r % 2 == 0 || y / r % 2 == 0);
      }
    }
  }
  Surface surface = BoundaryOfCubes(size, filled);
  surface.V /= r;
  // Diffusion by a fixed length takes steps in proportion to the square of the resolution.
  for (int step = 0; step < std::max(2, r * r / 6); ++step)
  {
    SmoothOnce(surface);
  }
  return surface;
}

Surface DoubleTorus(int resolution)
{
  return PerforatedSlab(2, 1, resolution);
}

Surface Prism(int around, int along)
{
  const double side = 2.0 * std::sin(Pi / around);
  return ClosedGrid(
    around, along, false,
    [=](int i, int j)
    {
      const double angle = 2.0 * Pi * i / around;
      return Vector3(std::cos(angle), std::sin(angle), side * j);
    },
    Never);
}

Surface FlatTorus(int n, int subdivisions)
{
  const double height = 1.5;
  const int twist = n / 4; // of the inner tube, in corners of the polygons
  Builder builder;
  for (int k = 0; k < n; ++k)
  {
    const double angle = 2.0 * Pi * k / n;
    builder.AddPoint(std::cos(angle), std::sin(angle), 0.0);
  }
  for (int k = 0; k < n; ++k)
  {
    const double angle = 2.0 * Pi * (k + 0.5) / n;
    builder.AddPoint(std::cos(angle), std::sin(angle), height);
  }
  const auto bottom = [n](int k) { return k % n; };
  const auto top = [n](int k) { return n + k % n; };
  for (int k = 0; k < n; ++k)
  {
    builder.AddTriangle(bottom(k), bottom(k + 1), top(k));
    builder.AddTriangle(top(k), bottom(k + 1), top(k + 1));
    builder.AddTriangle(bottom(k + 1), bottom(k), top(k + twist));
    builder.AddTriangle(bottom(k + 1), top(k + twist), top(k + twist + 1));
  }
  // The inner triangles are turned inside out, so that both tubes bound the space between them.
  Surface surface = builder.Build();
  for (int s = 0; s < subdivisions; ++s)
  {
    surface = Subdivide(surface);
  }
  return surface;
}

Surface SphereWithZeroAreaFaces(int subdivisions, int count)
{
  Surface surface = Icosphere(subdivisions);
  std::vector<Vector3> points;
  std::vector<std::array<int, 3>> faces;
  for (int v = 0; v < surface.V.rows(); ++v)
  {
    points.push_back(surface.V.row(v).transpose());
  }
  for (int f = 0; f < surface.F.rows(); ++f)
  {
    faces.push_back({ surface.F(f, 0), surface.F(f, 1), surface.F(f, 2) });
  }
  const auto addPoint = [&points](const Vector3& p)
  {
    points.push_back(p);
    return static_cast<int>(points.size()) - 1;
  };

  const TriangleMesh sphere = surface.Mesh();
  const int numberOfFaces = sphere.NumberOfFaces();
  std::vector<char> touched(points.size(), 0);
  const auto isFreeAround = [&](int h) { // claims the corners of all faces around the tail
    std::vector<int> corners = { sphere.Tail(h) };
    int spoke = h;
    do
    {
      corners.push_back(sphere.Head(spoke));
      spoke = sphere.Twin(TriangleMesh::Previous(spoke));
    } while (spoke != h);
    const bool isFree = std::none_of(corners.begin(), corners.end(), [&touched](int v) { return touched[v] != 0; });
    for (int v : corners)
    {
      touched[v] |= isFree ? 1 : 0;
    }
    return isFree;
  };

  int placed = 0;
  for (int i = 0; i < numberOfFaces && placed < 2 * count; ++i)
  {
    const int h = 3 * ((37 * i) % numberOfFaces); // all over the sphere
    if (!isFreeAround(h))
    {
      continue;
    }
    const int v = sphere.Tail(h);
    if (placed++ % 2 == 0)
    {
      // Cut the first side of the face in its middle, on this side of it only.
      const int f = TriangleMesh::FaceOf(h);
      const auto [a, b, c] = faces[f];
      const int m = addPoint(0.5 * (points[a] + points[b]));
      faces[f] = { a, m, c };
      faces.push_back({ m, b, c });
      faces.push_back({ a, b, m });
      continue;
    }
    // Give three consecutive faces around the vertex to a copy of it, and close the gap with two
    // triangles.
    const int second = sphere.Twin(TriangleMesh::Previous(h));
    const int third = sphere.Twin(TriangleMesh::Previous(second));
    const int copy = addPoint(points[v]);
    for (int outgoing : { h, second, third })
    {
      std::array<int, 3>& face = faces[TriangleMesh::FaceOf(outgoing)];
      std::replace(face.begin(), face.end(), v, copy);
    }
    faces.push_back({ v, sphere.Head(h), copy });
    faces.push_back({ copy, sphere.Tail(TriangleMesh::Previous(third)), v });
  }
  if (placed < 2 * count)
  {
    throw std::logic_error("the sphere has no room for so many degenerate faces");
  }

  Builder builder;
  for (const Vector3& p : points)
  {
    builder.AddPoint(p);
  }
  for (const auto& [a, b, c] : faces)
  {
    builder.AddTriangle(a, b, c);
  }
  return builder.Build();
}

Surface Needle(int subdivisions, double ratio)
{
  Surface surface = Icosphere(subdivisions);
  surface.V.col(2) *= ratio;
  return surface;
}

Surface CapsuleFromRectangle(int around, int along)
{
  // Along the profile: a quarter of a circle, a line of length 2, another quarter.
  const double length = Pi + 2.0;
  return Grid(
    around, along,
    [&](int column, int row)
    {
      const double s = length * row / along;
      const double arc = s < 0.5 * Pi ? s : s > 0.5 * Pi + 2.0 ? s - 2.0 : 0.5 * Pi;
      const double radius = row == 0 || row == along ? 0.0 : std::sin(arc);
      const double angle = 2.0 * Pi * (column % around) / around;
      return Vector3(radius * std::cos(angle), radius * std::sin(angle), s - arc - std::cos(arc));
    },
    Never);
}

Surface MoebiusStrip(int around)
{
  Builder builder;
  for (int i = 0; i < around; ++i)
  {
    const double angle = 2.0 * Pi * i / around;
    for (double offset : { -0.3, 0.3 })
    {
      const double radius = 1.0 + offset * std::cos(0.5 * angle);
      builder.AddPoint(radius * std::cos(angle), radius * std::sin(angle), offset * std::sin(0.5 * angle));
    }
  }
  for (int i = 0; i < around; ++i)
  {
    const bool isLast = i + 1 == around;
    const int next = isLast ? 0 : 2 * (i + 1);
    builder.AddQuad(2 * i, next + (isLast ? 1 : 0), next + (isLast ? 0 : 1), 2 * i + 1);
  }
  return builder.Build();
}

Surface PinchedTetrahedra()
{
  Builder builder;
  builder.AddPoint(0.0, 0.0, 0.0);
  for (double sign : { 1.0, -1.0 })
  {
    const int a = builder.AddPoint(sign, 0.0, 0.0);
    const int b = builder.AddPoint(0.0, sign, 0.0);
    const int c = builder.AddPoint(0.0, 0.0, sign);
    builder.AddTriangle(0, b, a);
    builder.AddTriangle(0, c, b);
    builder.AddTriangle(0, a, c);
    builder.AddTriangle(a, b, c);
  }
  return builder.Build();
}

Surface Union(const Surface& a, const Surface& b, const Vector3& offset)
{
  Surface both{ Points(a.V.rows() + b.V.rows(), 3), Triangles(a.F.rows() + b.F.rows(), 3) };
  both.V << a.V, b.V.rowwise() + offset.transpose();
  both.F << a.F, (b.F.array() + static_cast<int>(a.V.rows())).matrix();
  return both;
}

Surface Flattened(const Surface& surface, double factor)
{
  Surface flat = surface;
  flat.V.col(2) *= factor;
  return flat;
}

Surface Subdivide(const Surface& surface)
{
  const TriangleMesh mesh = surface.Mesh();
  const int numberOfVertices = mesh.NumberOfVertices();
  Surface fine{ Points(numberOfVertices + mesh.NumberOfEdges(), 3), Triangles(4 * mesh.NumberOfFaces(), 3) };
  fine.V.topRows(numberOfVertices) = surface.V;
  for (int e = 0; e < mesh.NumberOfEdges(); ++e)
  {
    const auto [a, b] = mesh.EdgeVertices(e);
    fine.V.row(numberOfVertices + e) = 0.5 * (surface.V.row(a) + surface.V.row(b));
  }
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    std::array<int, 3> middle;
    for (int k = 0; k < 3; ++k)
    {
      middle[k] = numberOfVertices + mesh.EdgeOf(3 * f + k);
    }
    for (int k = 0; k < 3; ++k)
    {
      fine.F.row(4 * f + k) << surface.F(f, k), middle[k], middle[(k + 2) % 3];
    }
    fine.F.row(4 * f + 3) << middle[0], middle[1], middle[2];
  }
  return fine;
}

Relabelled Relabel(const Surface& surface, unsigned seed)
{
  Random random(seed);
  const auto permutation = [&random](int size)
  {
    std::vector<int> numbers(size);
    std::iota(numbers.begin(), numbers.end(), 0);
    for (int i = size - 1; i > 0; --i)
    {
      std::swap(numbers[i], numbers[random.Index(i + 1)]);
    }
    return numbers;
  };
  Relabelled relabelled{ surface, permutation(static_cast<int>(surface.V.rows())),
    permutation(static_cast<int>(surface.F.rows())) };
  for (int v = 0; v < surface.V.rows(); ++v)
  {
    relabelled.Result.V.row(relabelled.NewVertices[v]) = surface.V.row(v);
  }
  for (int f = 0; f < surface.F.rows(); ++f)
  {
    const int first = random.Index(3);
    for (int k = 0; k < 3; ++k)
    {
      relabelled.Result.F(relabelled.NewFaces[f], k) = relabelled.NewVertices[surface.F(f, (first + k) % 3)];
    }
  }
  return relabelled;
}

Surface RotatedAndScaled(const Surface& surface, double angle, double scale, Eigen::Matrix3d* rotation)
{
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  if (rotation)
  {
    *rotation = turn;
  }
  return { scale * surface.V * turn.transpose(), surface.F };
}

}
