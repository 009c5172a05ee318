#ifndef dmgBenchmarksRealForm_h
#define dmgBenchmarksRealForm_h

#include "Benchmarks/Peers/Peer.h"
#include "Support/ComplexPairs.h"
#include "Support/ExecutionContext.h"
#include "Support/SparseAssembly.h"

#include <memory>
#include <string>
#include <utility>

namespace dmg::peers
{

/// A matrix on pairs (real, imaginary): an entry a + ib becomes the block (a, -b; b, a). A Hermitian matrix becomes
/// a symmetric one with each eigenvalue twice.
inline SparseMatrix<double> RealForm(const SparseMatrix<Complex>& A)
{
  const int* const offsets = A.outerIndexPtr();
  const auto size = [offsets](int r) { return 2 * (offsets[r / 2 + 1] - offsets[r / 2]); };
  return FillRows<double>(2 * static_cast<int>(A.rows()), 2 * static_cast<int>(A.cols()), SerialContext(), size,
    [&A, offsets](int r, int* columns, double* values)
    {
      for (int k = offsets[r / 2]; k < offsets[r / 2 + 1]; ++k)
      {
        const Complex entry = A.valuePtr()[k];
        *columns++ = 2 * A.innerIndexPtr()[k];
        *columns++ = 2 * A.innerIndexPtr()[k] + 1;
        *values++ = r % 2 == 0 ? entry.real() : entry.imag();
        *values++ = r % 2 == 0 ? -entry.imag() : entry.real();
      }
    });
}

/// A solver of real systems, given complex ones.
class RealFormPeer : public Peer<Complex>
{
public:
  explicit RealFormPeer(std::unique_ptr<Peer<double>> peer)
    : Real(std::move(peer))
  {
  }

  std::string Name() const override { return this->Real->Name(); }

  void Prepare(const SparseMatrix<Complex>& matrix) override
  {
    SparseMatrix<double> real = RealForm(matrix);
    this->A.swap(real);
    this->Real->Prepare(this->A);
  }

  int Solve(const Vector<Complex>& b, double tolerance, Vector<Complex>& x) override
  {
    Vector<double> pairs;
    const int iterations = this->Real->Solve(AsPairs(b), tolerance, pairs);
    x = AsComplex(pairs);
    return iterations;
  }

  long long Bytes() const override { return this->Real->Bytes(); }

private:
  const std::unique_ptr<Peer<double>> Real;
  SparseMatrix<double> A;
};

}

#endif
