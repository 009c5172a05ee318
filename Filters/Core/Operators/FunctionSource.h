#ifndef dmgFunctionSource_h
#define dmgFunctionSource_h

#include "Mesh/TriangleMesh.h"
#include "Support/SumOverProcesses.h"
#include "Support/Types.h"

#include <string>
#include <vector>

namespace dmg
{

/// The treatment of a source that does not sum to zero where nothing holds the solution.
enum class NetSource
{
  Refuse,  ///< an error that names the sum
  TakeOut, ///< its mean by area is subtracted
};

/// The integrals of f lambda_v, #V: f is linear on faces and has the given values at vertices, lambda_v is 1 at vertex v and 0 at all
/// others.
Vector<double> IntegratedSource(const TriangleMesh& mesh, const Vector<double>& f);

/// The integrals of lambda_v, #V: a third of the area of the faces around.
Vector<double> IntegratedSource(const TriangleMesh& mesh);

/// \throw InvalidInput a sum over a part of a surface where nothing is held is more than 1e-9 of that of magnitudes.
/// \param part for the message; may be empty.
void CheckNetSource(double sum, double sumOfMagnitudes, const std::string& part);

/// Connected component of every vertex, numbered as FaceComponents does.
std::vector<int> VertexComponents(const TriangleMesh& mesh);

/// The components of a surface on which no value is prescribed, where the solution of a Poisson problem is free by a constant.
class FreeComponents
{
public:
  /// \param components of vertices; borrowed.
  /// \param prescribed vertices.
  FreeComponents(const std::vector<int>& components, const std::vector<int>& prescribed);
  /// The free components of a surface that is spread over several processes. Functions that sum are collective.
  /// \param components of the vertices of this process; below \p bound, by numbers that all processes agree on.
  FreeComponents(
    const std::vector<int>& components, int bound, const std::vector<int>& prescribed, SumOverProcesses sum);
  /// The free components among those of some vertices.
  static FreeComponents Of(const std::vector<int>& components, const std::vector<int>& vertices);

  bool IsFree(int component) const { return this->AreFree[component] != 0; }
  bool AreAny() const;
  /// The first vertex of each, ascending.
  std::vector<int> FirstVertices() const;

  /// Makes a source sum to zero on each.
  /// \param areas of vertices.
  /// \throw InvalidInput its sum is more than 1e-9 of the sum of its magnitudes, and is to be refused.
  void Balance(Vector<double>& source, const Vector<double>& areas, NetSource net) const;
  /// Makes the mean of a function zero on each.
  void Centre(Vector<double>& u, const Vector<double>& areas) const;
  /// Shifts a function on each so that it vanishes at one vertex.
  /// \param vertices one of each.
  void VanishAt(const std::vector<int>& vertices, Vector<double>& u) const;

  /// Sums of numbers of the vertices over each; zero for other components.
  Vector<double> Sums(const Vector<double>& numbers) const;

private:
  const std::vector<int>& Components;
  const SumOverProcesses Sum;
  std::vector<char> AreFree; ///< by component
};

}

#endif
