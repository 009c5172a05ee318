// A field on a surface in pieces, where memory runs out on the last rank:
//
//   WithoutMemory K    the K-th request of the code of this project or of PETSc fails, there; 0: none
//
// Prints how many requests there were, or what all ranks throw.

#include "Pieces/FieldSolverInPieces.h"
#include "Pieces/PetscSession.h"
#include "Pieces/Ranks.h"

#include "../Partitions.h"
#include "Support/Errors.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <link.h>
#include <new>

extern "C"
{
  void* __libc_malloc(std::size_t);
  void* __libc_calloc(std::size_t, std::size_t);
  void* __libc_realloc(void*, std::size_t);
  void* __libc_memalign(std::size_t, std::size_t);
  void __libc_free(void*);
}

namespace
{

bool isCounting = false;
long long requests = 0;
long long failing = 0;

struct Code
{
  std::uintptr_t Begin = 0, End = 0;
};

/// Requests of MPI and of the standard library are spared, which do not survive that.
std::array<Code, 2> FindCode()
{
  std::array<Code, 2> code;
  dl_iterate_phdr(
    [](dl_phdr_info* library, std::size_t, void* found)
    {
      auto& ours = *static_cast<std::array<Code, 2>*>(found);
      const bool isProgram = ours[0].End == 0; // it comes first
      const bool isPetsc = std::strstr(library->dlpi_name, "petsc") != nullptr;
      for (int k = 0; (isProgram || isPetsc) && k < library->dlpi_phnum; ++k)
      {
        const auto& segment = library->dlpi_phdr[k];
        if (segment.p_type == PT_LOAD && (segment.p_flags & PF_X))
        {
          const std::uintptr_t begin = library->dlpi_addr + segment.p_vaddr;
          ours[isProgram ? 0 : 1] = { begin, begin + segment.p_memsz };
        }
      }
      return 0;
    },
    &code);
  return code;
}

std::array<Code, 2> code;

/// \param caller the code that the request comes from.
bool Fails(const void* caller)
{
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  const bool isOurs = isCounting &&
    std::any_of(
      code.begin(), code.end(), [&](const Code& each) { return address >= each.Begin && address < each.End; });
  return isOurs && ++requests == failing;
}

}

extern "C"
{
  void* malloc(std::size_t size)
  {
    return Fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size);
  }
  void* calloc(std::size_t number, std::size_t size)
  {
    return Fails(__builtin_return_address(0)) ? nullptr : __libc_calloc(number, size);
  }
  void* realloc(void* memory, std::size_t size)
  {
    return Fails(__builtin_return_address(0)) ? nullptr : __libc_realloc(memory, size);
  }
  void* memalign(std::size_t alignment, std::size_t size)
  {
    return Fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
  }
  void* aligned_alloc(std::size_t alignment, std::size_t size)
  {
    return Fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
  }
  int posix_memalign(void** memory, std::size_t alignment, std::size_t size)
  {
    *memory = Fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
    return *memory ? 0 : ENOMEM;
  }
}

void* operator new(std::size_t size)
{
  void* const memory = Fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size);
  return memory ? memory : throw std::bad_alloc();
}
void operator delete(void* memory) noexcept
{
  __libc_free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  __libc_free(memory);
}

namespace
{

using namespace dmg;

void Solve(const SurfacePiece& piece)
{
  FieldSolverInPieces solver(MPI_COMM_WORLD, piece);
  FieldProblem problem;
  problem.Constraints = test::OneDirection(solver.Piece());
  if (!solver.Solve(problem).Report.Converged)
  {
    throw SolverFailure("the field has not converged");
  }
}

}

int main(int count, char** arguments)
{
  MPI_Init(&count, &arguments);
  code = FindCode();
  failing = count > 1 ? std::atoll(arguments[1]) : 0;
  {
    const Ranks all(MPI_COMM_WORLD);
    const PetscSession started; // PETSc itself does not survive a failure before its handlers of errors are there
    const bool isLast = all.Rank() == all.Size() - 1;
    const test::CutPiece cut = test::PieceHere(test::IrregularSphere(4, 3));
    bool hasThrown = false;
    isCounting = isLast;
    try
    {
      Solve(cut.Piece);
    }
    catch (const MemoryRanOut&)
    {
      hasThrown = true;
    }
    isCounting = false;
    if (all.Sum(hasThrown ? 1LL : 0LL) == all.Size())
    {
      std::printf("all ranks throw\n");
    }
    else if (isLast)
    {
      std::printf("%lld requests\n", requests);
    }
    Solve(cut.Piece); // as if nothing had been
  }
  MPI_Finalize();
  return 0;
}
