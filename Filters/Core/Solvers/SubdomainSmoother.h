#ifndef dmgSubdomainSmoother_h
#define dmgSubdomainSmoother_h

#include "Solvers/CholeskySolver.h"
#include "Solvers/Subdomain.h"
#include "Support/ExecutionContext.h"
#include "Support/PartColouring.h"
#include "Support/RowTiles.h"
#include "Support/Types.h"

#include <optional>
#include <vector>

namespace dmg
{

/// Multiplicative Schwarz on subdomains of thousands of unknowns, for a sum of squares, A = B^T B + D with D
/// diagonal. They need not cover all unknowns, and may overlap.
///
/// Where triangles are needles, fields of 1e-9 of the diagonal's energy reach over many of them: too far for
/// the dense blocks of BlockSmoother, and too faint for their single precision. A sparse factor in double
/// precision holds them, in less memory than dense blocks of a tenth of its size. Same bits for any number of
/// threads.
class SubdomainSmoother
{
public:
  /// All arguments are borrowed and must stay where they are. SetDiagonal comes next.
  /// \param B the factor. \param tiles of its rows.
  /// \param subdomains none is empty.
  SubdomainSmoother(const SparseMatrix<double>& B, const RowTiles& tiles,
    const std::vector<Subdomain>& subdomains);

  /// A = B^T B + D. Factors are simplicial (FactorKind): many of them are made at once.
  /// \param D one entry per unknown, >= 0. Infinite: the unknown is zero.
  /// \throw SolverFailure memory ran out.
  /// Cost: a sparse Cholesky factorisation per subdomain; ordered and analysed the first time only.
  void SetDiagonal(const Vector<double>& D, const ExecutionContext& context);

  /// Smooths A x = b from x = 0, once over all subdomains.
  /// \param x, r on exit the result and its residual b - A x; zero where unknowns are held.
  void PreSmooth(const Vector<double>& b, Vector<double>& x, Vector<double>& r,
    const ExecutionContext& context);

  /// Smooths A x = b from the given x, subdomains in the opposite order: the adjoint of PreSmooth.
  /// \pre x is zero where unknowns are held.
  void PostSmooth(const Vector<double>& b, Vector<double>& x, const ExecutionContext& context);

  /// Held by this object, without the subdomains.
  long long Bytes() const;

private:
  /// What a subdomain has of its own.
  struct State
  {
    std::optional<CholeskySolver<double>> Factor;
    Vector<double> Bx; ///< on its rows
    Vector<double> Residual;
    Vector<double> Step;
  };

  /// B^T B + D on a subdomain, and a ridge; held unknowns apart.
  SparseMatrix<double> MatrixOf(const Subdomain& subdomain) const;
  bool IsHeld(int unknown) const;
  void Sweep(
    bool descending, const Vector<double>& b, Vector<double>& x, const ExecutionContext& context);
  /// Calls visit(firstRow, lastRow) for the tiles of B that know of subdomains; mostly few.
  template <class Visit>
  void ForTilesWithRows(const ExecutionContext& context, const Visit& visit) const;
  /// Solves for the unknowns of one subdomain.
  void Correct(int subdomain, const Vector<double>& b, Vector<double>& x);

  const SparseMatrix<double>& B;
  const RowTiles& Tiles;
  const std::vector<Subdomain>& Subdomains;
  PartColouring Colouring; ///< subdomains of a colour share no unknown and no row of B
  std::vector<State> States;
  std::vector<char> HaveRows; ///< of subdomains; by tile
  Vector<double> D;
  std::vector<int> Held; ///< unknowns where D is infinite
  Vector<double> Bx; ///< current where subdomains have rows
};

}

#endif
