#include "Support/NamedSurfaces.h"

namespace dmg::test
{

std::vector<NamedSurface> SmallSurfaces()
{
  return {
    { "irregular plane", IrregularPlane(8, 6, 1) },
    { "disk", Disk(4) },
    { "annulus", Annulus(10, 3) },
    { "irregular sphere", IrregularSphere(2, 2) },
    { "irregular torus", IrregularTorus(14, 8, 3) },
    { "smallest torus", Torus(3, 3) },
    { "double torus", DoubleTorus(2) },
    { "needle", Needle(2, 50.0) },
    { "two components", Union(Icosphere(1), Disk(3), Vector3(4.0, 0.0, 0.0)) },
  };
}

std::vector<NamedSurface> SurfacesToDecimate()
{
  return {
    { "sphere", IrregularSphere(4, 7) },
    { "torus", IrregularTorus(64, 24, 11) },
    { "thin torus", IrregularTorus(160, 8, 12, 1.0, 0.1) },
    { "double torus", DoubleTorus(5) },
    { "disk", Disk(24) },
    { "irregular plane", IrregularPlane(40, 30, 5) },
    { "annulus", Annulus(60, 16) },
    { "needle", Needle(4, 20.0) },
    { "two components", Union(Icosphere(4), Torus(48, 16), Vector3(5.0, 0.0, 0.0)) },
  };
}

}
