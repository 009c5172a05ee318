#ifndef dmgQuadric_h
#define dmgQuadric_h

#include "Support/Types.h"

namespace dmg
{

/// Sum of squared distances to planes, each times a weight. Garland and Heckbert 1997.
class Quadric
{
public:
  /// Adds weight (n . p - offset)^2, with n of unit length.
  void AddPlane(const Vector3& n, double offset, double weight)
  {
    this->XX += weight * n[0] * n[0];
    this->XY += weight * n[0] * n[1];
    this->XZ += weight * n[0] * n[2];
    this->YY += weight * n[1] * n[1];
    this->YZ += weight * n[1] * n[2];
    this->ZZ += weight * n[2] * n[2];
    this->X -= weight * offset * n[0];
    this->Y -= weight * offset * n[1];
    this->Z -= weight * offset * n[2];
    this->Constant += weight * offset * offset;
  }

  void Add(const Quadric& q)
  {
    this->XX += q.XX;
    this->XY += q.XY;
    this->XZ += q.XZ;
    this->YY += q.YY;
    this->YZ += q.YZ;
    this->ZZ += q.ZZ;
    this->X += q.X;
    this->Y += q.Y;
    this->Z += q.Z;
    this->Constant += q.Constant;
  }

  double At(const Vector3& p) const
  {
    return p[0] * (this->XX * p[0] + 2.0 * (this->XY * p[1] + this->XZ * p[2] + this->X)) +
      p[1] * (this->YY * p[1] + 2.0 * (this->YZ * p[2] + this->Y)) + p[2] * (this->ZZ * p[2] + 2.0 * this->Z) +
      this->Constant;
  }

private:
  double XX = 0.0, XY = 0.0, XZ = 0.0, YY = 0.0, YZ = 0.0, ZZ = 0.0;
  double X = 0.0, Y = 0.0, Z = 0.0;
  double Constant = 0.0;
};

}

#endif
