#ifndef dmgBenchmarksPrescriptions_h
#define dmgBenchmarksPrescriptions_h

#include "HarmonicField.h"
#include "Support/Random.h"

#include <cmath>
#include <set>
#include <string>
#include <vector>

/// What the benchmarks prescribe.
namespace dmg::benchmarks
{

/// The names of the tables; the thesis's.
inline std::string NameOf(Discretisation kind)
{
  switch (kind)
  {
    case Discretisation::OneForm:
      return "DEC";
    case Discretisation::FaceField:
      return "face-based";
    default:
      return "power";
  }
}

/// How many elements are prescribed.
struct Regime
{
  std::string Name;
  int Count; ///< or, if 0,
  double Share; ///< of all elements

  int Of(int elements) const
  {
    return std::min(elements,
      this->Count > 0 ? this->Count : static_cast<int>(std::ceil(this->Share * elements)));
  }
};

/// Elements that can be prescribed.
inline int NumberOfElements(const TriangleMesh& mesh, Discretisation kind)
{
  return kind == Discretisation::OneForm ? mesh.NumberOfEdges() : mesh.NumberOfFaces();
}

/// Random elements with weight 1 and random directions of unit length; on an edge, the integral of
/// one in its plane.
inline FieldConstraints RandomConstraints(
  const TriangleMesh& mesh, Discretisation kind, const Regime& regime, test::Random& random)
{
  constexpr double pi = 3.14159265358979323846;
  const int elements = NumberOfElements(mesh, kind);
  std::set<int> chosen;
  while (static_cast<int>(chosen.size()) < regime.Of(elements))
  {
    chosen.insert(random.Index(elements));
  }
  FieldConstraints constraints;
  constraints.Elements.assign(chosen.begin(), chosen.end());
  const int size = static_cast<int>(chosen.size());
  constraints.Weights.assign(size, 1.0);
  const bool isOneForm = kind == Discretisation::OneForm;
  constraints.Values.resize(isOneForm ? size : 2 * size);
  for (int b = 0; b < size; ++b)
  {
    const double angle = random.Uniform(0.0, 2.0 * pi);
    if (isOneForm)
    {
      const auto [i, j] = mesh.EdgeVertices(constraints.Elements[b]);
      constraints.Values[b] = (mesh.Position(j) - mesh.Position(i)).norm() * std::cos(angle);
    }
    else
    {
      constraints.Values[2 * b] = std::cos(angle);
      constraints.Values[2 * b + 1] = std::sin(angle);
    }
  }
  return constraints;
}

}

#endif
