#ifndef dmgFlatCylinder_h
#define dmgFlatCylinder_h

#include "Support/MeshFactory.h"
#include "Support/Types.h"

#include <cmath>

namespace dmg::test
{

/// The waves of a prism of squares, which closes after one turn. Its cotangent Laplacian is that of the five-point stencil, so that products
/// of waves around and along are modes but for rounding.
class FlatCylinder
{
public:
  /// \param around columns. \param along rows of squares.
  FlatCylinder(int around, int along)
    : Around(around)
    , Along(along)
  {
  }

  Surface Shape() const { return Prism(this->Around, this->Along); }
  double Edge() const { return 2.0 * std::sin(Pi / this->Around); }

  /// So many whole waves around, and half waves along that end flat (cosines) or, with \p isZeroAtEnds, at zero (sines).
  Vector<double> Mode(int wavesAround, int halfWavesAlong, bool isZeroAtEnds = false) const
  {
    Vector<double> mode(this->Size());
    for (int j = 0; j <= this->Along; ++j)
    {
      const double angle = Pi * halfWavesAlong * j / this->Along;
      const double along = isZeroAtEnds ? std::sin(angle) : std::cos(angle);
      for (int i = 0; i < this->Around; ++i)
      {
        mode[this->Vertex(i, j)] = along * std::cos(2.0 * Pi * wavesAround * i / this->Around);
      }
    }
    return mode;
  }

  /// 2 pi over the root of the mode's eigenvalue on the grid.
  double LengthOf(int wavesAround, int halfWavesAlong) const
  {
    const double around = std::sin(Pi * wavesAround / this->Around);
    const double along = std::sin(0.5 * Pi * halfWavesAlong / this->Along);
    return Pi * this->Edge() / std::sqrt(around * around + along * along);
  }

private:
  int Vertex(int i, int j) const { return j * this->Around + i; }
  int Size() const { return this->Around * (this->Along + 1); }

  const int Around, Along;
};

}

#endif
