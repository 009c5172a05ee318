#include "Flows/FittedDerivatives.h"

#include "Support/AllIndices.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{
namespace
{

/// The distance of the farthest cells that take part, in steps from cell to cell.
constexpr int MostRings = 3;

/// The numbers that solve linear equations best, in the sense of least squares.
template <class Number, int Size>
class LeastSquares
{
public:
  using Row = Eigen::Matrix<double, Size, 1>;

  void Add(const Row& row, Number value)
  {
    this->Products.noalias() += row * row.transpose();
    this->Values += value * row;
    ++this->Equations;
  }

  /// Finds the solution. \return whether the equations determine it; else there is none.
  bool Solve()
  {
    constexpr double SmallestShare = 1e-3;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Size, Size>> spectrum(this->Products);
    const Row& energies = spectrum.eigenvalues();
    if (!(energies[0] > SmallestShare * 6.0 / Size * this->Equations))
    {
      return false;
    }
    this->Solution.setZero();
    for (int k = 0; k < Size; ++k)
    {
      const Row mode = spectrum.eigenvectors().col(k);
      const Number ofMode = mode.template cast<Number>().dot(this->Values);
      this->Solution += ofMode / energies[k] * mode;
    }
    return true;
  }

  Eigen::Matrix<Number, Size, 1> Solution;

private:
  Eigen::Matrix<double, Size, Size> Products = Eigen::Matrix<double, Size, Size>::Zero();
  Eigen::Matrix<Number, Size, 1> Values = Eigen::Matrix<Number, Size, 1>::Zero();
  int Equations = 0;
};

Vector2 AsVector(Complex number)
{
  return { number.real(), number.imag() };
}

/// A linear flow X(q) = X_0 + X_1 q_1 + X_2 q_2 in the plane, from vectors at places. Places are scaled so that the cells around the
/// vertex spread by 1 in all directions: cells that are long and thin determine a flow as well as others.
class FitOfVectors
{
public:
  explicit FitOfVectors(const Eigen::Matrix2d& scaling)
    : Scaling(scaling)
  {
  }

  /// Both components have the same equations.
  void Add(Complex place, Complex vector)
  {
    const Vector2 q = this->Scaling * AsVector(place);
    this->Flow.Add({ 1.0, q[0], q[1] }, vector);
  }

  /// Finds the flow. \return whether the data determine it.
  bool Solve() { return this->Flow.Solve(); }

  /// Its derivatives: column k is that along axis k.
  Eigen::Matrix2d Derivatives() const
  {
    Eigen::Matrix2d alongScaled;
    alongScaled << AsVector(this->Flow.Solution[1]), AsVector(this->Flow.Solution[2]);
    return alongScaled * this->Scaling;
  }

private:
  const Eigen::Matrix2d Scaling;
  LeastSquares<Complex, 3> Flow;
};

/// A linear flow, from its integrals along straight lines. Places are scaled as in FitOfVectors, and the flow with them, so that its integrals stay:
/// X . dx = X' . dq for q = S x and X = S^T X'. So the directions of the lines spread, too.
class FitOfIntegrals
{
public:
  explicit FitOfIntegrals(const Eigen::Matrix2d& scaling)
    : Scaling(scaling)
  {
  }

  void Add(Complex tail, Complex head, double integral)
  {
    const Vector2 way = this->Scaling * AsVector(head - tail);
    const double length = way.norm();
    if (length > 0.0)
    {
      const Vector2 middle = this->Scaling * AsVector(0.5 * (tail + head));
      const Vector2 d = way / length;
      LeastSquares<double, 6>::Row row;
      row << d, middle[0] * d, middle[1] * d;
      this->Flow.Add(row, integral / length);
    }
  }

  bool Solve() { return this->Flow.Solve(); }

  Eigen::Matrix2d Derivatives() const
  {
    Eigen::Matrix2d scaled;
    scaled << this->Flow.Solution.segment<2>(2), this->Flow.Solution.segment<2>(4);
    return this->Scaling.transpose() * scaled * this->Scaling;
  }

private:
  const Eigen::Matrix2d Scaling;
  LeastSquares<double, 6> Flow;
};

/// The cells around a vertex, in a map of the surface to the tangent plane there.
class Neighbourhood
{
public:
  Neighbourhood(const FramedMesh& surface, const SurfaceRelation& relation, int vertex)
    : Surface(surface)
    , Relation(relation)
    , Centre(vertex)
    , Vertices{ vertex }
  {
    this->Grow();
  }

  /// Adds the cells around all of its vertices.
  void Grow()
  {
    for (const int vertex : this->Vertices)
    {
      this->Surface.Mesh.VisitFan(vertex,
        [this](int h)
        {
          const ElementRow faces = this->Relation.FacesOf(this->Relation.CellOf(TriangleMesh::FaceOf(h)));
          this->Faces.insert(this->Faces.end(), faces.begin(), faces.end());
        });
    }
    MakeUnique(this->Faces);
    for (const int face : this->Faces)
    {
      const auto corners = this->Surface.Mesh.FaceCorners().row(face);
      this->Vertices.insert(this->Vertices.end(), corners.begin(), corners.end());
    }
    MakeUnique(this->Vertices);
  }

  /// The place of a point of the surface in the tangent plane: in its direction, at its distance through space.
  Complex Place(const Vector3& point) const
  {
    const Vector3 offset = point - this->Surface.Mesh.Position(this->Centre);
    const Complex tangential = this->Surface.Vertices.ToComplex(this->Centre, offset);
    const double length = std::abs(tangential);
    return length > 0.0 ? offset.norm() / length * tangential : Complex(0.0);
  }

  /// A tangent vector of an element, in the tangent plane.
  Complex Carried(const TangentFrames& frames, int element, const Vector3& vector) const
  {
    return TransportTurn(frames, element, this->Surface.Vertices, this->Centre) * frames.ToComplex(element, vector);
  }

  /// The mean over the faces of a cell, so that it does not matter into which triangles a cell that bends was cut, nor which is the first.
  Complex CarriedOfCell(int face, const Vector3& vector) const
  {
    Complex sum = 0.0;
    double area = 0.0;
    for (const int part : this->Relation.FacesOf(this->Relation.CellOf(face)))
    {
      const double weight = this->Surface.Mesh.FaceArea(part);
      sum += weight * this->Carried(this->Surface.Faces, part, vector);
      area += weight;
    }
    return area > 0.0 ? sum / area : this->Carried(this->Surface.Faces, face, vector);
  }

  /// The scaling of places for which the vertices have the variance 1 in all directions.
  Eigen::Matrix2d Scaling() const
  {
    Eigen::Matrix2d variances = Eigen::Matrix2d::Zero();
    for (const int vertex : this->Vertices)
    {
      const Complex place = this->Place(this->Surface.Mesh.Position(vertex));
      const Vector2 at(place.real(), place.imag());
      variances += at * at.transpose() / static_cast<double>(this->Vertices.size());
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(variances);
    const double largest = axes.eigenvalues()[1];
    if (!(largest > 0.0))
    {
      return Eigen::Matrix2d::Zero();
    }
    constexpr double Thinnest = 1e-16; // squared: cells without an area
    const Vector2 spreads = axes.eigenvalues().cwiseMax(Thinnest * largest).cwiseSqrt();
    return spreads.cwiseInverse().asDiagonal() * axes.eigenvectors().transpose();
  }

  const FramedMesh& Surface;
  const SurfaceRelation& Relation;
  const int Centre;
  std::vector<int> Faces; ///< of the cells; sorted
  std::vector<int> Vertices;

private:
  static void MakeUnique(std::vector<int>& items)
  {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
  }
};

/// \param addTo adds the data of a neighbourhood to a fit.
template <class LinearFit, class AddTo>
DerivativesAtVertices Fit(
  const FramedMesh& surface, const SurfaceRelation& relation, const ExecutionContext& context, const AddTo& addTo)
{
  constexpr int Grain = 1024;
  const int vertices = surface.Mesh.NumberOfVertices();
  DerivativesAtVertices derivatives{ Vector<double>(vertices), Vector<double>(vertices) };
  const auto fitAt = [&](int vertex)
  {
    Neighbourhood around(surface, relation, vertex);
    for (int ring = 1;; ++ring)
    {
      LinearFit fit(around.Scaling());
      addTo(around, fit);
      if (fit.Solve())
      {
        const Eigen::Matrix2d of = fit.Derivatives();
        derivatives.Divergence[vertex] = of.trace();
        derivatives.Vorticity[vertex] = of(1, 0) - of(0, 1);
        return;
      }
      if (ring == MostRings)
      {
        derivatives.Divergence[vertex] = derivatives.Vorticity[vertex] = std::numeric_limits<double>::quiet_NaN();
        return;
      }
      around.Grow();
    }
  };
  context.ParallelFor(0, vertices, Grain,
    [&fitAt](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        fitAt(vertex);
      }
    });
  return derivatives;
}

Vector<double> VorticityOfForm(const TriangleMesh& mesh, const Vector<double>& form, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  Vector<double> vorticity(mesh.NumberOfVertices());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        double circulation = 0.0, area = 0.0;
        mesh.VisitFan(vertex,
          [&](int h)
          {
            const int face = TriangleMesh::FaceOf(h);
            area += mesh.FaceArea(face);
            for (int side = 3 * face; side < 3 * face + 3; ++side)
            {
              circulation += mesh.EdgeSign(side) * form[mesh.EdgeOf(side)];
            }
          });
        vorticity[vertex] = area > 0.0 ? circulation / area : 0.0;
      }
    });
  return vorticity;
}

}

std::string WarningOfUndetermined(const DerivativesAtVertices& derivatives)
{
  const Eigen::Index number = derivatives.Divergence.array().isNaN().count();
  const bool isVorticityToo = derivatives.Vorticity.array().isNaN().any();
  return number > 0 ? (isVorticityToo ? "Divergence and vorticity are" : "Divergence is") + std::string(" NaN at ") +
      std::to_string(number) +
      " points, where the cells around do not determine a linear flow, as in straits one cell wide; vectors of points "
      "would determine it"
                    : "";
}

Points CellCentres(const TriangleMesh& mesh, const SurfaceRelation& relation)
{
  Points centres(mesh.NumberOfFaces(), 3);
  std::vector<int> corners;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    if (const Vector3* const centre = relation.CentreOf(relation.CellOf(face)))
    {
      centres.row(face) = centre->transpose();
      continue;
    }
    corners.clear();
    for (const int part : relation.FacesOf(relation.CellOf(face)))
    {
      corners.insert(corners.end(), mesh.FaceCorners().row(part).begin(), mesh.FaceCorners().row(part).end());
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    centres.row(face) = mesh.VertexPositions()(corners, All).colwise().mean();
  }
  return centres;
}

DerivativesAtVertices DerivativesOfVertexVectors(
  const FramedMesh& surface, const SurfaceRelation& relation, const Points& vectors, const ExecutionContext& context)
{
  return Fit<FitOfVectors>(surface, relation, context,
    [&](const Neighbourhood& around, FitOfVectors& fit)
    {
      for (const int vertex : around.Vertices)
      {
        fit.Add(around.Place(surface.Mesh.Position(vertex)),
          around.Carried(surface.Vertices, vertex, vectors.row(vertex).transpose()));
      }
    });
}

DerivativesAtVertices DerivativesOfCellVectors(const FramedMesh& surface, const SurfaceRelation& relation,
  const Points& vectors, const Points& places, const ExecutionContext& context)
{
  return Fit<FitOfVectors>(surface, relation, context,
    [&](const Neighbourhood& around, FitOfVectors& fit)
    {
      for (const int face : around.Faces)
      {
        if (relation.FacesOf(relation.CellOf(face)).front() == face) // once for each cell
        {
          fit.Add(
            around.Place(places.row(face).transpose()), around.CarriedOfCell(face, vectors.row(face).transpose()));
        }
      }
    });
}

DerivativesAtVertices DerivativesOfForm(const FramedMesh& surface, const SurfaceRelation& relation,
  const Vector<double>& form, const std::vector<char>& isGiven, const ExecutionContext& context)
{
  const TriangleMesh& mesh = surface.Mesh;
  DerivativesAtVertices derivatives = Fit<FitOfIntegrals>(surface, relation, context,
    [&](const Neighbourhood& around, FitOfIntegrals& fit)
    {
      for (const int face : around.Faces)
      {
        for (int h = 3 * face; h < 3 * face + 3; ++h)
        {
          const int edge = mesh.EdgeOf(h);
          const double length = (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).norm();
          const int twin = mesh.Twin(h);
          const bool isSeenTwice = twin >= 0 && twin < h &&
            std::binary_search(around.Faces.begin(), around.Faces.end(), TriangleMesh::FaceOf(twin));
          if (!isGiven[edge] || isSeenTwice || !(length > 0.0))
          {
            continue;
          }
          const Complex tail = around.Place(mesh.Position(mesh.Tail(h)));
          const Complex head = around.Place(mesh.Position(mesh.Head(h)));
          fit.Add(tail, head, std::abs(head - tail) / length * mesh.EdgeSign(h) * form[edge]);
        }
      }
    });
  derivatives.Vorticity = VorticityOfForm(mesh, form, context);
  return derivatives;
}

}
