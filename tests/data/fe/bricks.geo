SetFactory("Built-in");
// bricks x 0..1, wedges x 1..2, section 1 x 0.5 (y, z)
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {1,1,0}; Point(4) = {0,1,0}; Point(5) = {2,0,0}; Point(6) = {2,1,0};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1}; Line(5) = {2,5}; Line(6) = {5,6}; Line(7) = {6,3};
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};
Curve Loop(2) = {5,6,7,-2}; Plane Surface(2) = {2};
Transfinite Curve {1,2,3,4,5,6,7} = 3;
Transfinite Surface {1,2};
Recombine Surface {1};
a[] = Extrude {0,0,0.5} { Surface{1}; Layers{1}; Recombine; };
b[] = Extrude {0,0,0.5} { Surface{2}; Layers{1}; Recombine; };
Physical Volume("BRICKS") = {a[1]};
Physical Volume("WEDGES") = {b[1]};
Physical Surface("END") = {a[5]};
Physical Surface("BOTTOM") = {1,2};
Physical Curve("EDGE") = {5};
Physical Point("CORNER") = {1};
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;
