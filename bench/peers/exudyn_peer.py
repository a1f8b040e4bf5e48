"""Exudyn: flexible chains (floating frame, Hurty-Craig-Bampton modes of the mesh of models.py) and rigid ones.

The plane of motion is x-y here, so that the hinges are about z; y corresponds to z of models.py.
"""
import sys
import time

import numpy as np

import models
import pendulum_check

sys.exudynFast = True  # the module without range checks and with AVX2
import exudyn as exu  # noqa: E402
from exudyn import FEM, itemInterface as item  # noqa: E402

exu.SetWriteToConsole(False)
VERSION = exu.__version__


def reduced_link():
    fem = FEM.FEMinterface()
    positions, _ = models.link_mesh()
    fem.nodes = {"Position": positions}
    fem.massMatrix, fem.stiffnessMatrix = models.link_matrices()
    ends = models.faces(positions)
    fem.ComputeHurtyCraigBamptonModes(ends, models.NORMAL_MODES, computationMode=FEM.HCBstaticModeSelection.RBE2)
    # All nodes of a face move as one rigid body: its four corners give the same marker as all eight, in less time.
    corners = [[n for n in end if np.abs(positions[n, 1:]).min() > 0.4 * models.SIDE] for end in ends]
    return fem, corners


def check(times):
    """One link integrated by pendulum_check.py with the modes of Exudyn."""
    fem, _ = reduced_link()
    return pendulum_check.tip(fem.modeBasis["matrix"], fem.massMatrix, fem.stiffnessMatrix, times)


class FlexibleChain:
    """A chain that can be run again and again; options: see `settings`.

    Gravity on all nodes acts at the centre of mass of the deformed link. The corresponding load of Exudyn (on the body) is
    several times cheaper and omits the deformation in the torque on the floating frame.
    """

    def __init__(self, links, rotation="RotationRxyz", gravity_on_nodes=False):
        fem, ends = reduced_link()
        shares = np.asarray(fem.massMatrix[::3, ::3].sum(axis=1)).ravel() / models.MASS
        self.system = exu.SystemContainer()
        self.mbs = mbs = self.system.AddSystem()
        cms = FEM.ObjectFFRFreducedOrderInterface(fem, rigidBodyNodeType=f"NodeType.{rotation}")
        ground = mbs.AddObject(item.ObjectGround())
        before = mbs.AddMarker(item.MarkerBodyRigid(bodyNumber=ground))
        for i in range(links):
            link = cms.AddObjectFFRFreducedOrder(mbs, positionRef=[i * models.LENGTH, 0, 0])
            body = link["oFFRFreducedOrder"]
            if gravity_on_nodes:
                centre = mbs.AddMarker(item.MarkerSuperElementPosition(
                    bodyNumber=body, meshNodeNumbers=np.arange(len(shares)), weightingFactors=shares))
                mbs.AddLoad(item.LoadForceVector(markerNumber=centre, loadVector=[0, -models.GRAVITY * models.MASS, 0]))
            else:
                mass = mbs.AddMarker(item.MarkerBodyMass(bodyNumber=body))
                mbs.AddLoad(item.LoadMassProportional(markerNumber=mass, loadVector=[0, -models.GRAVITY, 0]))
            start, end = (mbs.AddMarker(item.MarkerSuperElementRigid(
                bodyNumber=body, meshNodeNumbers=np.array(e), weightingFactors=np.full(len(e), 1 / len(e))))
                for e in ends)
            mbs.AddObject(item.ObjectJointRevoluteZ(markerNumbers=[before, start]))
            before = end
        self.tip = mbs.AddSensor(item.SensorMarker(markerNumber=before, storeInternal=True,
                                                   outputVariableType=exu.OutputVariableType.Position))
        mbs.Assemble()
        self.counts = {}

    def settings(self, step, duration=1.0, tolerance=1e-8, modified=True, contractivity=0.5, radius=0.9, sparse=False,
                 record=None):
        s = exu.SimulationSettings()
        s.timeIntegration.numberOfSteps = round(duration / step)
        s.timeIntegration.endTime = duration
        s.timeIntegration.generalizedAlpha.spectralRadius = radius
        s.timeIntegration.newton.useModifiedNewton = modified
        s.timeIntegration.newton.modifiedNewtonContractivity = contractivity
        s.timeIntegration.newton.relativeTolerance = tolerance
        s.timeIntegration.verboseMode = 0
        s.solutionSettings.writeSolutionToFile = False
        s.solutionSettings.sensorsWritePeriod = record or duration
        s.displayComputationTime = False
        s.parallel.numberOfThreads = 1
        if sparse:
            s.linearSolverType = exu.LinearSolverType.EigenSparse
        return s

    def run(self, record=None, **options):
        """Runs from the start; processor seconds, and with `record` [s] the tip (time, x, z) at that period."""
        s = self.settings(record=record, **options)
        before = time.process_time()
        self.mbs.SolveDynamic(s, updateInitialValues=False)
        seconds = time.process_time() - before
        if record is None:
            return seconds, None
        return seconds, self.mbs.GetSensorStoredData(self.tip)[:, :3]


class RigidChain:
    """The rigid chain as a kinematic tree in joint coordinates."""

    def __init__(self, links):
        self.system = exu.SystemContainer()
        self.mbs = mbs = self.system.AddSystem()
        node = mbs.AddNode(item.NodeGenericODE2(referenceCoordinates=[0.0] * links, initialCoordinates=[0.0] * links,
                                                initialCoordinates_t=[0.0] * links, numberOfODE2Coordinates=links))
        tree = mbs.AddObject(item.ObjectKinematicTree(
            nodeNumber=node, gravity=[0, -models.GRAVITY, 0], jointTypes=[exu.JointType.RevoluteZ] * links,
            linkParents=list(range(-1, links - 1)), jointTransformations=exu.Matrix3DList([np.eye(3)] * links),
            jointOffsets=exu.Vector3DList([[models.LENGTH if i else 0.0, 0, 0] for i in range(links)]),
            linkInertiasCOM=exu.Matrix3DList([np.diag(models.LINK_INERTIA)] * links),
            linkCOMs=exu.Vector3DList([[models.LENGTH / 2, 0, 0]] * links), linkMasses=[models.MASS] * links))
        self.tip = mbs.AddSensor(item.SensorKinematicTree(objectNumber=tree, linkNumber=links - 1, storeInternal=True,
                                                          localPosition=[models.LENGTH, 0, 0],
                                                          outputVariableType=exu.OutputVariableType.Position))
        mbs.Assemble()

    def run(self, record=None, step=1e-3, duration=1.0, integrator="RK44"):
        s = FlexibleChain.settings(None, step, duration, record=record)
        s.timeIntegration.explicitIntegration.useLieGroupIntegration = False
        before = time.process_time()
        self.mbs.SolveDynamic(s, solverType=getattr(exu.DynamicSolverType, integrator), updateInitialValues=False)
        seconds = time.process_time() - before
        return seconds, (self.mbs.GetSensorStoredData(self.tip)[:, :3] if record else None)
