#ifndef dmgPetscObjects_h
#define dmgPetscObjects_h

#include "Pieces/Solvers/PetscSession.h"
#include "Pieces/Solvers/PieceLevels.h"
#include "Pieces/Surface/Ranks.h"
#include "Support/Types.h"

#include <petscksp.h>

#include <utility>
#include <vector>

#ifndef PETSC_USE_COMPLEX
#error "PETSc has to be one for complex numbers"
#endif

namespace dmg
{

inline void Destroy(Mat& matrix)
{
  CheckDestroyed(MatDestroy(&matrix));
}
inline void Destroy(Vec& vector)
{
  CheckDestroyed(VecDestroy(&vector));
}
inline void Destroy(KSP& solver)
{
  CheckDestroyed(KSPDestroy(&solver));
}

/// An object of PETSc's, which it counts references to. Where somebody has
/// ended PETSc since, the object is lost with it.
template <class Object>
class Owned
{
public:
  Owned() = default;
  ~Owned()
  {
    if (this->Life == PetscSession::Ends())
    {
      Destroy(this->Held);
    }
  }
  Owned(Owned&& other) noexcept
    : Held(std::exchange(other.Held, nullptr))
    , Life(other.Life)
  {
  }
  Owned& operator=(Owned&& other) noexcept
  {
    std::swap(this->Held, other.Held);
    std::swap(this->Life, other.Life);
    return *this;
  }
  operator Object() const { return this->Held; }
  /// For functions that make one.
  Object* Place()
  {
    this->Life = PetscSession::Ends();
    return &this->Held;
  }

private:
  Object Held = nullptr;
  int Life = 0; ///< of PETSc: its ends before
};

/// A matrix of PETSc's that works on the memory of ours: there is no second copy of its rows.
class PetscRows
{
public:
  /// Collective. Takes the rows.
  /// \throw InvalidInput there are more columns than PETSc can count.
  PetscRows(const Ranks& ranks, RowsOfRank<Complex> rows);
  PetscRows(const PetscRows&) = delete; // PETSc knows where the memory is
  PetscRows& operator=(const PetscRows&) = delete;

  operator Mat() const { return this->Matrix; }

  int NumberOfRows() const { return static_cast<int>(this->OwnColumns.rows()); }
  /// Visits the entries of a row: visit(value, whether it is on the diagonal of the whole matrix). Solvers that PETSc has set up do
  /// not hear of changes.
  template <class Visit>
  void VisitRow(int row, const Visit& visit);

private:
  void Split(RowsOfRank<Complex>& rows, long long firstColumn);

  SparseMatrix<Complex> OwnColumns; ///< numbered from 0
  std::vector<PetscInt> Offsets,
    Columns;                                        ///< of those, where PETSc's integers are longer than ours
  std::vector<PetscInt> OtherOffsets, OtherColumns; ///< those of other ranks
  std::vector<PetscScalar> OtherValues;
  Owned<Mat> Matrix;
};

template <class Visit>
void PetscRows::VisitRow(int row, const Visit& visit)
{
  for (SparseMatrix<Complex>::InnerIterator entry(this->OwnColumns, row); entry; ++entry)
  {
    visit(entry.valueRef(), entry.col() == row);
  }
  for (PetscInt k = this->OtherOffsets[row]; k < this->OtherOffsets[row + 1]; ++k)
  {
    visit(this->OtherValues[k], false);
  }
}

}

#endif
