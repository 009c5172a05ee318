#include "Quads/Map/SeamlessMap.h"

#include "Quads/Map/ClosestIntegers.h"
#include "Quads/Map/ExactOrder.h"
#include "Support/DisjointSets.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// The singular values that a map keeps to, where 1 is that of the length of edges that is wanted.
constexpr double SmallestStretch = 0.4;
constexpr double LargestStretch = 2.5;
constexpr int StepsOfLimiting = 12;

SparseMatrix<double> AsMatrix(const IntegerLattice& lattice)
{
  SparseMatrix<double> matrix(static_cast<int>(lattice.Rows.size()), lattice.Dimension);
  for (int row = 0; row < matrix.rows(); ++row)
  {
    matrix.startVec(row);
    for (const auto& [parameter, coefficient] : lattice.Rows[row])
    {
      matrix.insertBack(row, parameter) = static_cast<double>(coefficient);
    }
  }
  matrix.finalize();
  return matrix;
}

/// Adds a small part of the mean of the diagonal to it: free shifts of the map cost nothing otherwise.
void ShiftDiagonal(SparseMatrix<double>& matrix, double part)
{
  const double shift = part * matrix.diagonal().sum() / std::max<Eigen::Index>(matrix.rows(), 1);
  for (int row = 0; row < matrix.rows(); ++row)
  {
    matrix.coeffRef(row, row) += shift;
  }
}

/// The linear map with gradients g_u and g_v as z -> a z + b conj(z): its singular values are |a| + |b| and |a| - |b|, the latter less
/// than zero where it turns over.
struct PlaneMap
{
  Complex Conformal, Anticonformal;

  PlaneMap(Complex ofU, Complex ofV)
  {
    const Complex alongX(ofU.real(), ofV.real()), alongY(ofU.imag(), ofV.imag());
    const Complex i(0.0, 1.0);
    this->Conformal = 0.5 * (alongX - i * alongY);
    this->Anticonformal = 0.5 * (alongX + i * alongY);
  }

  std::array<Complex, 2> Gradients() const
  {
    const Complex alongX = this->Conformal + this->Anticonformal;
    const Complex alongY = (this->Conformal - this->Anticonformal) * Complex(0.0, 1.0);
    return { Complex(alongX.real(), alongY.real()), Complex(alongX.imag(), alongY.imag()) };
  }

  /// \param otherwise the rotation to take where there is none.
  void LimitStretch(Complex otherwise)
  {
    const double a = std::abs(this->Conformal), b = std::abs(this->Anticonformal);
    const double large = std::clamp(a + b, SmallestStretch, LargestStretch);
    const double small = std::clamp(a - b, SmallestStretch, LargestStretch);
    constexpr double Smallest = 1e-12;
    this->Conformal = 0.5 * (large + small) * (a > Smallest ? this->Conformal / a : otherwise);
    this->Anticonformal = b > Smallest ? 0.5 * (large - small) * this->Anticonformal / b : Complex(0.0);
  }
};

}

int OrientationInMap(const MapOfCorners& map, int face)
{
  const auto &a = map[3 * face], &b = map[3 * face + 1], &c = map[3 * face + 2];
  return SignOfDifference(b[0] - a[0], c[1] - a[1], b[1] - a[1], c[0] - a[0]);
}

int NumberOfFaces(const MapOfCorners& map, int orientation)
{
  int count = 0;
  for (int face = 0; 3 * face < static_cast<int>(map.size()); ++face)
  {
    count += OrientationInMap(map, face) == orientation ? 1 : 0;
  }
  return count;
}

SeamlessMap::SeamlessMap(
  const FramedMesh& surface, const CrossField& field, SeamlessVariables variables, const ExecutionContext& context)
  : Field(field)
  , Mesh(surface.Mesh)
  , Variables(std::move(variables))
  , Lattice(AsMatrix(SolveOverIntegers(static_cast<int>(this->Variables.Integers.cols()), this->Variables.Conditions)))
  , Sides(3 * surface.Mesh.NumberOfFaces())
  , Areas(surface.Mesh.NumberOfFaces())
  , Weights(surface.Mesh.NumberOfFaces())
{
  constexpr double ThinnestArea =
    1e-6; // over the square of the longest side; cotangents of thinner faces would drown the others
  for (int face = 0; face < this->Mesh.NumberOfFaces(); ++face)
  {
    double longest = 0.0;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      this->Sides[h] = surface.Faces.ToComplex(
        face, this->Mesh.Position(this->Mesh.Head(h)) - this->Mesh.Position(this->Mesh.Tail(h)));
      longest = std::max(longest, std::norm(this->Sides[h]));
    }
    const double area = std::imag(std::conj(this->Sides[3 * face]) * this->Sides[3 * face + 1]);
    this->Areas[face] = std::max(area, ThinnestArea * longest);
    this->Weights[face] = std::max(area, 0.0) / this->Areas[face];
  }
  context.Checkpoint(0.1);
  this->Assemble(PartOfContext(context, 0.1, 0.5));
  this->FindSchurComplement(PartOfContext(context, 0.5, 1.0));
}

Complex SeamlessMap::HatGradient(int face, int k) const
{
  return Complex(0.0, 1.0) * this->Sides[3 * face + (k + 1) % 3];
}

void SeamlessMap::Assemble(const ExecutionContext& context)
{
  // The cotangent matrix of each face, for both coordinates of its corners.
  SparseMatrix<double> K(6 * this->Mesh.NumberOfFaces(), 6 * this->Mesh.NumberOfFaces());
  K.reserve(18 * static_cast<Eigen::Index>(this->Mesh.NumberOfFaces()));
  for (int row = 0; row < K.rows(); ++row)
  {
    const int face = row / 6, corner = row / 2 % 3;
    K.startVec(row);
    for (int other = 0; other < 3; ++other)
    {
      const Complex product = std::conj(this->HatGradient(face, corner)) * this->HatGradient(face, other);
      K.insertBack(row, 6 * face + 2 * other + row % 2) = product.real() / (2.0 * this->Areas[face]);
    }
  }
  K.finalize();
  context.Checkpoint(0.15);
  SparseMatrix<double> KR = K * this->Variables.Reals;
  context.Checkpoint(0.3);
  SparseMatrix<double> H = SparseMatrix<double>(this->Variables.Reals.transpose()) * KR;
  ShiftDiagonal(H, 1e-10);
  H.makeCompressed();
  context.Checkpoint(0.4);
  const SparseMatrix<double> Z = this->Variables.Integers * this->Lattice;
  this->RealsByIntegers = SparseMatrix<double>(KR.transpose()) * Z;
  this->GroupParameters(Z);
  this->AddEnergyOfIntegers(Z, K, PartOfContext(context, 0.41, 0.5));
  K = SparseMatrix<double>(); // makes room for the factor
  KR = SparseMatrix<double>();
  if (H.rows() > 0)
  {
    this->Factor = std::make_unique<CholeskySolver<double>>(H, FillOrdering::AMD, PartOfContext(context, 0.5, 1.0));
  }
  context.Checkpoint(1.0);
}

void SeamlessMap::GroupParameters(const SparseMatrix<double>& Z)
{
  const std::vector<int> components = FaceComponents(this->Mesh);
  const int size = static_cast<int>(Z.cols());
  DisjointSets sets(size + static_cast<int>(components.size())); // of parameters and components
  for (int row = 0; row < Z.rows(); ++row)
  {
    for (SparseMatrix<double>::InnerIterator entry(Z, row); entry; ++entry)
    {
      sets.Unite(static_cast<int>(entry.col()), size + components[row / 6]);
    }
  }
  std::vector<int> groups(size, -1); // by the first parameter of each
  for (int parameter = 0; parameter < size; ++parameter)
  {
    int& group = groups[sets.Smallest(parameter)];
    if (group < 0)
    {
      group = static_cast<int>(this->Parameters.size());
      this->Parameters.emplace_back();
    }
    this->Parameters[group].Numbers.push_back(parameter);
  }
}

void SeamlessMap::AddEnergyOfIntegers(
  const SparseMatrix<double>& Z, const SparseMatrix<double>& K, const ExecutionContext& context)
{
  const int size = static_cast<int>(Z.cols());
  const int block = std::max(32, size / 64); // rows at a time: with many integers it takes a while
  std::vector<std::pair<ParametersOfComponent*, int>> places(size);
  for (ParametersOfComponent& component : this->Parameters)
  {
    const auto count = static_cast<int>(component.Numbers.size());
    component.Schur.setZero(count, count);
    for (int k = 0; k < count; ++k)
    {
      places[component.Numbers[k]] = { &component, k };
    }
  }
  const SparseMatrix<double> transposed = Z.transpose();
  for (int first = 0; first < size; first += block)
  {
    context.Checkpoint(static_cast<double>(first) / size);
    const SparseMatrix<double> rows = transposed.middleRows(first, std::min(block, size - first));
    const SparseMatrix<double> product = SparseMatrix<double>(rows * K) * Z;
    for (int row = 0; row < product.rows(); ++row)
    {
      auto& [component, number] = places[first + row];
      for (SparseMatrix<double>::InnerIterator entry(product, row); entry; ++entry)
      {
        component->Schur(number, places[entry.col()].second) = entry.value();
      }
    }
  }
}

void SeamlessMap::FindSchurComplement(const ExecutionContext& context)
{
  constexpr std::size_t Block = 32; // columns that are solved for at a time
  std::size_t most = 0;
  for (const ParametersOfComponent& component : this->Parameters)
  {
    most = std::max(most, component.Numbers.size());
  }
  const Eigen::SparseMatrix<double> columns = this->RealsByIntegers;
  for (std::size_t first = 0; first < most && this->Factor; first += Block)
  {
    const std::size_t count = std::min(Block, most - first);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(columns.rows(), static_cast<Eigen::Index>(count));
    for (const ParametersOfComponent& component : this->Parameters)
    {
      for (std::size_t k = first; k < std::min(first + count, component.Numbers.size()); ++k)
      {
        right.col(static_cast<Eigen::Index>(k - first)) += columns.col(component.Numbers[k]);
      }
    }
    Eigen::MatrixXd solution;
    this->Factor->Solve(right, solution);
    const Eigen::MatrixXd products = columns.transpose() * solution;
    for (ParametersOfComponent& component : this->Parameters)
    {
      for (std::size_t k = first; k < std::min(first + count, component.Numbers.size()); ++k)
      {
        component.Schur.col(static_cast<Eigen::Index>(k)) -=
          products(component.Numbers, static_cast<Eigen::Index>(k - first));
      }
    }
    context.Checkpoint(0.7 * static_cast<double>(first + count) / static_cast<double>(most));
  }
  const double step = 0.3 / static_cast<double>(std::max<std::size_t>(this->Parameters.size(), 1));
  double done = 0.7;
  for (ParametersOfComponent& component : this->Parameters)
  {
    Eigen::MatrixXd& S = component.Schur;
    S = Eigen::MatrixXd(0.5 * (S + S.transpose()));
    S.diagonal().array() += 1e-9 * S.trace() / static_cast<double>(S.rows());
    component.InverseOfSchur = InverseOf(S, PartOfContext(context, done, done + step));
    done += step;
  }
}

SeamlessMap::Targets SeamlessMap::FromField(const Vector<double>& lengths, const ExecutionContext& context) const
{
  Targets targets(lengths.size());
  context.ParallelFor(0, static_cast<int>(lengths.size()), Grain,
    [&](int begin, int end)
    {
      for (int face = begin; face < end; ++face)
      {
        const Complex ofU = std::polar(1.0 / lengths[face], this->Field.Angles[face]);
        targets[face] = { ofU, Complex(0.0, 1.0) * ofU };
      }
    });
  return targets;
}

SeamlessMap::Targets SeamlessMap::LimitedDistortion(
  const Vector<double>& corners, const Vector<double>& lengths, const ExecutionContext& context) const
{
  Targets targets(lengths.size());
  context.ParallelFor(0, static_cast<int>(lengths.size()), Grain,
    [&](int begin, int end)
    {
      for (int face = begin; face < end; ++face)
      {
        std::array<Complex, 2> gradients{ 0.0, 0.0 };
        for (int k = 0; k < 3; ++k)
        {
          const Complex hat = this->HatGradient(face, k) * (lengths[face] / this->Areas[face]);
          gradients[0] += hat * corners[6 * face + 2 * k];
          gradients[1] += hat * corners[6 * face + 2 * k + 1];
        }
        PlaneMap map(gradients[0], gradients[1]);
        map.LimitStretch(std::polar(1.0, -this->Field.Angles[face]));
        gradients = map.Gradients();
        targets[face] = { gradients[0] / lengths[face], gradients[1] / lengths[face] };
      }
    });
  return targets;
}

Vector<double> SeamlessMap::RightSide(const Targets& targets, const ExecutionContext& context) const
{
  Vector<double> right(6 * targets.size());
  context.ParallelFor(0, static_cast<int>(targets.size()), Grain,
    [&](int begin, int end)
    {
      for (int row = 6 * begin; row < 6 * end; ++row)
      {
        const int face = row / 6;
        const Complex product = std::conj(targets[face][row % 2]) * this->HatGradient(face, row / 2 % 3);
        right[row] = 0.5 * this->Weights[face] * product.real();
      }
    });
  return right;
}

Vector<double> SeamlessMap::RealParameters(const Vector<double>& right, Vector<double>& reals)
{
  this->SolveReals(right, Vector<double>::Zero(this->Lattice.cols()), reals);
  const Vector<double> ofIntegers = this->Variables.Integers.transpose() * right;
  const Vector<double> c = this->Lattice.transpose() * ofIntegers - this->RealsByIntegers.transpose() * reals;
  Vector<double> parameters = Vector<double>::Zero(c.size());
  for (const ParametersOfComponent& component : this->Parameters)
  {
    parameters(component.Numbers) = component.InverseOfSchur * c(component.Numbers);
  }
  return parameters;
}

void SeamlessMap::SolveReals(const Vector<double>& right, const Vector<double>& parameters, Vector<double>& reals)
{
  const Vector<double> b = this->Variables.Reals.transpose() * right - this->RealsByIntegers * parameters;
  reals.resize(b.size());
  if (this->Factor)
  {
    this->Factor->Solve(b, reals);
  }
}

Vector<double> SeamlessMap::CornersOf(const Vector<double>& reals, const Vector<double>& parameters) const
{
  return this->Variables.Reals * reals + this->Variables.Integers * Vector<double>(this->Lattice * parameters);
}

MapOfCorners SeamlessMap::InFixedPoint(const Vector<double>& reals, const Vector<double>& parameters) const
{
  const Vector<double> integers = this->Variables.Integers * Vector<double>(this->Lattice * parameters);
  MapOfCorners map(3 * this->Mesh.NumberOfFaces());
  for (int row = 0; row < integers.size(); ++row)
  {
    FixedPoint number = std::llround(integers[row]) * FixedOne;
    for (SparseMatrix<double>::InnerIterator entry(this->Variables.Reals, row); entry; ++entry)
    {
      FixedPoint real = std::llround(reals[entry.col()] * static_cast<double>(FixedOne));
      real += (real & (FixedOne - 1)) == FixedOne / 2 ? 1 : 0;
      number += entry.value() > 0.0 ? real : -real;
    }
    map[row / 2][row % 2] = number;
  }
  return map;
}

double SeamlessMap::AreaOfRealMap(const Vector<double>& lengths, const ExecutionContext& context)
{
  const Vector<double> right = this->RightSide(this->FromField(lengths, context), context);
  Vector<double> reals;
  const Vector<double> parameters = this->RealParameters(right, reals);
  this->SolveReals(right, parameters, reals);
  const Vector<double> corners = this->CornersOf(reals, parameters);
  double area = 0.0;
  for (int face = 0; face < this->Mesh.NumberOfFaces(); ++face)
  {
    const Vector2 a = corners.segment<2>(6 * face), b = corners.segment<2>(6 * face + 2),
                  c = corners.segment<2>(6 * face + 4);
    area += 0.5 * ((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]);
  }
  return area;
}

MapOfCorners SeamlessMap::Map(const Vector<double>& lengths, const ExecutionContext& context)
{
  const Vector<double> right = this->RightSide(this->FromField(lengths, context), context);
  Vector<double> reals;
  const Vector<double> wanted = this->RealParameters(right, reals);
  Vector<double> parameters = wanted;
  const double step = 0.3 / static_cast<double>(std::max<std::size_t>(this->Parameters.size(), 1));
  double done = 0.1;
  for (const ParametersOfComponent& component : this->Parameters)
  {
    parameters(component.Numbers) = ClosestIntegers(
      component.Schur, component.InverseOfSchur, wanted(component.Numbers), PartOfContext(context, done, done + step));
    done += step;
  }
  this->SolveReals(right, parameters, reals);
  return this->LimitDistortion(
    this->InFixedPoint(reals, parameters), reals, parameters, lengths, PartOfContext(context, 0.4, 1.0));
}

MapOfCorners SeamlessMap::LimitDistortion(MapOfCorners map, Vector<double> reals, const Vector<double>& parameters,
  const Vector<double>& lengths, const ExecutionContext& context)
{
  MapOfCorners best = map;
  int fewest = NumberOfFaces(map, -1);
  for (int step = 0; step < StepsOfLimiting && fewest > 0; ++step)
  {
    context.Checkpoint(static_cast<double>(step) / StepsOfLimiting);
    const Targets targets = this->LimitedDistortion(this->CornersOf(reals, parameters), lengths, context);
    this->SolveReals(this->RightSide(targets, context), parameters, reals);
    map = this->InFixedPoint(reals, parameters);
    if (const int flipped = NumberOfFaces(map, -1); flipped < fewest)
    {
      fewest = flipped;
      best = map;
    }
  }
  return best;
}

}
