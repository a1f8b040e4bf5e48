// Lower wishbone of the Iltis' front left wheel as a forged plate with eyes, for Gmsh 4.8 or later:
//   gmsh -3 front_arm.geo -o front_arm.msh                         the mesh of the example (packed with gzip)
//   gmsh -3 front_arm.geo -setnumber size 9 -o front_arm_fine.msh
// Millimetres, in the arm's frame: origin on the hinge axis in the wheel plane, x forward, y to the ball, z up.
// Hardpoints as in examples/iltis/suspension.yaml. Drawn flat (x forward, s along the arm, n normal), then tilted.
SetFactory("OpenCASCADE");
DefineConstant[ size = {17, Name "Element size [mm]"} ];

hinge = 100;                             // half the distance of the eyes
ball_y = 313;  ball_z = -73;             // centre of the ball
shock_x = 75;  shock_y = 241;  shock_z = -61;

tilt = Atan2(ball_z, ball_y);
L = Sqrt(ball_y * ball_y + ball_z * ball_z);
shock_s = shock_y * Cos(tilt) + shock_z * Sin(tilt);
shock_n = shock_z * Cos(tilt) - shock_y * Sin(tilt);

half = 10;                               // half the thickness of the plate
eye_radius = 25;   eye_bore = 12;  eye_width = 44;
ball_radius = 30;  ball_bore = 15; ball_height = 44;
lug_radius = 17;   lug_bore = 7;

// Outline of the plate with a window.
p = newp;
Point(p)     = {-hinge - 16, 16, -half};
Point(p + 1) = { hinge + 16, 16, -half};
Point(p + 2) = {58, 190, -half};         // tab of the shock absorber
Point(p + 3) = {shock_x, shock_s - 14, -half};
Point(p + 4) = {shock_x, shock_s + 14, -half};
Point(p + 5) = {24, L, -half};
Point(p + 6) = {-24, L, -half};
For i In {0:6}
  Line(100 + i) = {p + i, p + (i + 1) % 7};
EndFor
w = newp;
Point(w)     = {-60, 52, -half};
Point(w + 1) = { 60, 52, -half};
Point(w + 2) = { 16, 225, -half};
Point(w + 3) = {-16, 225, -half};
For i In {0:3}
  Line(120 + i) = {w + i, w + (i + 1) % 4};
EndFor
Curve Loop(1) = {100:106};
Curve Loop(2) = {120:123};
Plane Surface(1) = {1, 2};
plate[] = Extrude {0, 0, 2 * half} { Surface{1}; };

Cylinder(5) = { hinge - eye_width / 2, 0, 0, eye_width, 0, 0, eye_radius};
Cylinder(6) = {-hinge - eye_width / 2, 0, 0, eye_width, 0, 0, eye_radius};
Cylinder(7) = {0, L, -ball_height / 2, 0, 0, ball_height, ball_radius};
Cylinder(8) = {shock_x, shock_s, 2 * shock_n - half, 0, 0, 2 * (half - shock_n), lug_radius};
BooleanUnion(10) = { Volume{plate[1]}; Delete; }{ Volume{5:8}; Delete; };
Cylinder(11) = { hinge - eye_width, 0, 0, 2 * eye_width, 0, 0, eye_bore};
Cylinder(12) = {-hinge - eye_width, 0, 0, 2 * eye_width, 0, 0, eye_bore};
Cylinder(13) = {0, L, -ball_height, 0, 0, 2 * ball_height, ball_bore};
Cylinder(14) = {shock_x, shock_s, -4 * half, 0, 0, 8 * half, lug_bore};
BooleanDifference(20) = { Volume{10}; Delete; }{ Volume{11:14}; Delete; };

// The bores are the interfaces: faces in boxes that nothing else fits into, chosen before the arm is tilted.
e = 0.5;
front[] = Surface In BoundingBox { hinge - eye_width / 2 - e, -eye_bore - e, -eye_bore - e,  hinge + eye_width / 2 + e, eye_bore + e, eye_bore + e};
rear[]  = Surface In BoundingBox {-hinge - eye_width / 2 - e, -eye_bore - e, -eye_bore - e, -hinge + eye_width / 2 + e, eye_bore + e, eye_bore + e};
ball[]  = Surface In BoundingBox {-ball_bore - e, L - ball_bore - e, -ball_height / 2 - e, ball_bore + e, L + ball_bore + e, ball_height / 2 + e};
shock[] = Surface In BoundingBox {shock_x - lug_bore - e, shock_s - lug_bore - e, -4 * half, shock_x + lug_bore + e, shock_s + lug_bore + e, 4 * half};
Rotate {{1, 0, 0}, {0, 0, 0}, tilt} { Volume{20}; }
Physical Volume("ARM") = {20};
Physical Surface("EYE_FRONT") = {front[]};
Physical Surface("EYE_REAR") = {rear[]};
Physical Surface("HINGE") = {front[], rear[]};
Physical Surface("BALL") = {ball[]};
Physical Surface("SHOCK") = {shock[]};

Mesh.MeshSizeMax = size;
Mesh.MeshSizeMin = size / 4;
Mesh.MeshSizeFromCurvature = 10;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;
Mesh.Optimize = 1;
Mesh.MshFileVersion = 4.1;
