#include "Quads/Map/SeamlessVariables.h"

#include "Support/Errors.h"

#include <array>
#include <utility>

namespace dmg
{

namespace
{

/// sign * root + terms. Roots are the coordinates of vertices in the first faces of their fans: 2 vertex and 2 vertex + 1.
struct Coordinate
{
  int Root = -1;
  int Sign = 1;
  IntegerTerms Terms;
};

Coordinate Negative(const Coordinate& a)
{
  return { a.Root, -a.Sign, Sum({}, a.Terms, -1) };
}

using Coordinates = std::array<Coordinate, 2>;

/// i^times w.
Coordinates Turned(const Coordinates& w, int times)
{
  switch ((times % 4 + 4) % 4)
  {
    case 1:
      return { Negative(w[1]), w[0] };
    case 2:
      return { Negative(w[0]), Negative(w[1]) };
    case 3:
      return { w[1], Negative(w[0]) };
    default:
      return w;
  }
}

/// w + sign t of a seam.
Coordinates Moved(Coordinates w, int seam, int sign)
{
  for (int c = 0; c < 2; ++c)
  {
    w[c].Terms = Sum(w[c].Terms, { { 2 * seam + c, 1 } }, sign);
  }
  return w;
}

/// Roots that are equal, but for a sign and integers: union-find with weights.
class EqualRoots
{
public:
  explicit EqualRoots(int size)
    : Parents(size)
    , IsInteger(size, 0)
  {
    for (int root = 0; root < size; ++root)
    {
      this->Parents[root].Root = root;
    }
  }

  int Size() const { return static_cast<int>(this->Parents.size()); }

  /// A coordinate in the root that stands for all equal ones.
  Coordinate Resolved(const Coordinate& a)
  {
    this->Compress(a.Root);
    const Coordinate& parent = this->Parents[a.Root];
    return { parent.Root, a.Sign * parent.Sign, Sum(a.Terms, parent.Terms, a.Sign) };
  }

  void MakeInteger(int root) { this->IsInteger[this->Resolved({ root, 1, {} }).Root] = 1; }
  /// \pre root stands for itself.
  bool IsAnInteger(int root) const { return this->IsInteger[root]; }

  /// \return whether the two had different roots; else nothing is done.
  bool Equate(const Coordinate& first, const Coordinate& second)
  {
    const Coordinate a = this->Resolved(first), b = this->Resolved(second);
    if (a.Root == b.Root)
    {
      return false;
    }
    this->Parents[a.Root] = { b.Root, a.Sign * b.Sign, Sum({}, Sum(b.Terms, a.Terms, -1), a.Sign) };
    this->IsInteger[b.Root] = this->IsInteger[a.Root] || this->IsInteger[b.Root];
    return true;
  }

private:
  /// Lets a root and all on the way point at the last one.
  void Compress(int root)
  {
    std::vector<int> way;
    for (; this->Parents[root].Root != root; root = this->Parents[root].Root)
    {
      way.push_back(root);
    }
    for (auto step = way.rbegin(); step != way.rend(); ++step)
    {
      Coordinate& a = this->Parents[*step];
      if (a.Root != root)
      {
        const Coordinate& parent = this->Parents[a.Root];
        a = { root, a.Sign * parent.Sign, Sum(a.Terms, parent.Terms, a.Sign) };
      }
    }
  }

  std::vector<Coordinate> Parents;
  std::vector<char> IsInteger; ///< by root that stands for itself
};

class VariablesOfMap
{
public:
  VariablesOfMap(const TriangleMesh& mesh, const SurfaceAngles& angles, const CrossField& field, const CutSurface& cut)
    : Mesh(mesh)
    , Angles(angles)
    , Field(field)
    , Cut(cut)
    , Roots(2 * mesh.NumberOfVertices())
    , Corners(3 * mesh.NumberOfFaces())
  {
  }

  SeamlessVariables Make(const std::vector<char>& isAligned)
  {
    for (int vertex = 0; vertex < this->Mesh.NumberOfVertices(); ++vertex)
    {
      this->GoAround(vertex);
    }
    for (int edge = 0; edge < this->Mesh.NumberOfEdges(); ++edge)
    {
      if (isAligned[edge])
      {
        this->Align(this->Mesh.HalfedgeOf(edge));
      }
    }
    this->FixShifts();
    this->NumberRoots();
    return this->Result();
  }

private:
  /// The coordinates of all corners around a vertex in those of the first one.
  void GoAround(int vertex)
  {
    const Coordinates first{ Coordinate{ 2 * vertex, 1, {} }, Coordinate{ 2 * vertex + 1, 1, {} } };
    Coordinates w = first;
    bool isCut = false;
    this->Mesh.VisitFan(vertex,
      [&](int h)
      {
        this->Corners[h] = w;
        const int side = TriangleMesh::Previous(h);
        if (this->Cut.Seams[side] >= 0)
        {
          w = this->Across(w, side);
          isCut = true;
        }
      });
    if (this->Field.Indices[vertex] != 0)
    {
      this->Roots.MakeInteger(2 * vertex);
      this->Roots.MakeInteger(2 * vertex + 1);
    }
    if (isCut && !this->Mesh.IsBoundaryVertex(vertex))
    {
      this->Equations.emplace_back(w[0], first[0]);
      this->Equations.emplace_back(w[1], first[1]);
    }
  }

  /// The coordinates beyond the side of a halfedge.
  Coordinates Across(const Coordinates& w, int h) const
  {
    const int seam = this->Cut.Seams[h];
    return this->Cut.IsForward[h] ? Moved(Turned(w, this->Cut.Matchings[h]), seam, 1)
                                  : Turned(Moved(w, seam, -1), -this->Cut.Matchings[this->Mesh.Twin(h)]);
  }

  /// Lets the ends of an edge have one coordinate in common, an integer.
  void Align(int h)
  {
    const int constant = RunsAlongU(this->Angles, this->Field, h) ? 1 : 0;
    const Coordinate &tail = this->Corners[h][constant], &head = this->Corners[TriangleMesh::Next(h)][constant];
    this->Roots.MakeInteger(tail.Root);
    this->Roots.MakeInteger(head.Root);
    if (!this->Roots.Equate(tail, head))
    {
      this->Equations.emplace_back(tail, head);
    }
  }

  /// The map of each component may be shifted by integers: lets the first integer root of either coordinate be zero.
  void FixShifts()
  {
    std::vector<std::array<char, 2>> isFixed;
    const std::vector<int> components = FaceComponents(this->Mesh);
    for (int root = 0; root < this->Roots.Size(); ++root)
    {
      const int component = components[TriangleMesh::FaceOf(this->Mesh.OutgoingHalfedge(root / 2))];
      isFixed.resize(std::max<std::size_t>(isFixed.size(), component + 1), { 0, 0 });
      const Coordinate a = this->Roots.Resolved({ root, 1, {} });
      if (!isFixed[component][root % 2] && this->Roots.IsAnInteger(a.Root))
      {
        isFixed[component][root % 2] = 1;
        this->Zeros.push_back(a);
      }
    }
  }

  void NumberRoots()
  {
    this->Numbers.assign(this->Roots.Size(), -1);
    this->NumberOfIntegers = 2 * this->Cut.NumberOfSeams;
    for (int root = 0; root < this->Roots.Size(); ++root)
    {
      if (this->Roots.Resolved({ root, 1, {} }).Root == root)
      {
        this->Numbers[root] = this->Roots.IsAnInteger(root) ? this->NumberOfIntegers++ : this->NumberOfReals++;
      }
    }
  }

  /// The integers of a coordinate, with its root if that is one.
  IntegerTerms AllIntegers(const Coordinate& a) const
  {
    return this->Roots.IsAnInteger(a.Root) ? Sum(a.Terms, { { this->Numbers[a.Root], 1 } }, a.Sign) : a.Terms;
  }

  void AddCondition(const IntegerTerms& sum, SeamlessVariables& variables) const
  {
    if (!sum.empty())
    {
      variables.Conditions.push_back(sum);
    }
  }

  SeamlessVariables Result()
  {
    SeamlessVariables variables;
    for (const auto& [first, second] : this->Equations)
    {
      const Coordinate a = this->Roots.Resolved(first), b = this->Roots.Resolved(second);
      const bool isReal = !this->Roots.IsAnInteger(a.Root) || !this->Roots.IsAnInteger(b.Root);
      if (isReal && (a.Root != b.Root || a.Sign != b.Sign))
      {
        throw UnexpectedFailure("the matchings of the field do not agree with its singularities");
      }
      this->AddCondition(Sum(this->AllIntegers(a), this->AllIntegers(b), -1), variables);
    }
    for (const Coordinate& zero : this->Zeros)
    {
      this->AddCondition(this->AllIntegers(zero), variables);
    }
    this->FillMatrices(variables);
    return variables;
  }

  void FillMatrices(SeamlessVariables& variables)
  {
    const int rows = 2 * static_cast<int>(this->Corners.size());
    variables.Reals.resize(rows, this->NumberOfReals);
    variables.Integers.resize(rows, this->NumberOfIntegers);
    variables.Reals.reserve(rows);
    for (int row = 0; row < rows; ++row)
    {
      const Coordinate a = this->Roots.Resolved(this->Corners[row / 2][row % 2]);
      variables.Reals.startVec(row);
      variables.Integers.startVec(row);
      if (!this->Roots.IsAnInteger(a.Root))
      {
        variables.Reals.insertBack(row, this->Numbers[a.Root]) = a.Sign;
      }
      for (const auto& [variable, coefficient] : this->AllIntegers(a))
      {
        variables.Integers.insertBack(row, variable) = static_cast<double>(coefficient);
      }
    }
    variables.Reals.finalize();
    variables.Integers.finalize();
  }

  const TriangleMesh& Mesh;
  const SurfaceAngles& Angles;
  const CrossField& Field;
  const CutSurface& Cut;
  EqualRoots Roots;
  std::vector<Coordinates> Corners;                         ///< by halfedge: at its tail
  std::vector<std::pair<Coordinate, Coordinate>> Equations; ///< pairs that are equal
  std::vector<Coordinate> Zeros;                            ///< coordinates that are zero
  std::vector<int> Numbers;                                 ///< of roots that stand for themselves, as columns
  int NumberOfReals = 0;
  int NumberOfIntegers = 0;
};

}

SeamlessVariables MakeSeamlessVariables(const TriangleMesh& mesh, const SurfaceAngles& angles, const CrossField& field,
  const CutSurface& cut, const std::vector<char>& isAligned)
{
  return VariablesOfMap(mesh, angles, field, cut).Make(isAligned);
}

}
