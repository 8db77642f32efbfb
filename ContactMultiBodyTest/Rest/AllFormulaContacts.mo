within ContactMultiBodyTest.Rest;
model AllFormulaContacts "Every contact of PureModelica brings a body to rest at the depth its weight asks for"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  parameter Real start[8]={0.101,0.101,0.051,0.101,0.201,0.201,0.201,0.201} "Heights at the start";
  ContactMultiBody.Parts.Body body[8](
    each m=1,
    each r_CM={0,0,0},
    each I_11=0.01,
    each I_22=0.01,
    each I_33=0.01,
    r_0(start={{i,0,start[i]} for i in 1:8}, each fixed=true),
    v_0(each fixed=true),
    each angles_fixed=true,
    angles_start={{if i == 2 or i == 7 then Modelica.Constants.pi/2 else 0,0,0} for i in 1:8},
    each w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.Parts.Ground stand[4](r={{i + 4,0,0} for i in 1:4});
  Modelica.Mechanics.MultiBody.Parts.FixedRotation lying[2](
    each r={0,0,0},
    each n={0,1,0},
    each angle=90,
    each animation=false);
  ContactMultiBody.PureModelica.SphereOnHalfSpace sphereOnHalfSpace(radius=0.1);
  ContactMultiBody.PureModelica.CapsuleOnHalfSpace capsuleOnHalfSpace(radius=0.1, length=0.2);
  ContactMultiBody.PureModelica.BoxOnHalfSpace boxOnHalfSpace(size={0.1,0.1,0.1});
  ContactMultiBody.PureModelica.CylinderOnHalfSpace cylinderOnHalfSpace(radius=0.1, length=0.2);
  ContactMultiBody.PureModelica.SphereOnSphere sphereOnSphere(radius1=0.1, radius2=0.1);
  ContactMultiBody.PureModelica.SphereOnCapsule sphereOnCapsule(radius1=0.1, radius2=0.1, length2=0.5);
  ContactMultiBody.PureModelica.CapsuleOnCapsule capsuleOnCapsule(radius1=0.1, length1=0.3, radius2=0.1, length2=0.3);
  ContactMultiBody.PureModelica.SphereOnBox sphereOnBox(radius=0.1, size={0.2,0.2,0.2});
equation
  connect(body[1].frame_a, sphereOnHalfSpace.frame[1]);
  connect(floor.frame_a, sphereOnHalfSpace.frame[2]);
  connect(body[2].frame_a, capsuleOnHalfSpace.frame[1]);
  connect(floor.frame_a, capsuleOnHalfSpace.frame[2]);
  connect(body[3].frame_a, boxOnHalfSpace.frame[1]);
  connect(floor.frame_a, boxOnHalfSpace.frame[2]);
  connect(body[4].frame_a, cylinderOnHalfSpace.frame[1]);
  connect(floor.frame_a, cylinderOnHalfSpace.frame[2]);
  connect(body[5].frame_a, sphereOnSphere.frame[1]);
  connect(stand[1].frame_a, sphereOnSphere.frame[2]);
  connect(body[6].frame_a, sphereOnCapsule.frame[1]);
  connect(stand[2].frame_a, lying[1].frame_a);
  connect(lying[1].frame_b, sphereOnCapsule.frame[2]);
  connect(body[7].frame_a, capsuleOnCapsule.frame[1]);
  connect(stand[3].frame_a, lying[2].frame_a);
  connect(lying[2].frame_b, capsuleOnCapsule.frame[2]);
  connect(body[8].frame_a, sphereOnBox.frame[1]);
  connect(stand[4].frame_a, sphereOnBox.frame[2]);
  annotation (experiment(StopTime=1, Tolerance=1e-7), Documentation(info="<html>
<p>Eight bodies fall by 1 mm on fixed shapes; <code>normalForce[1]</code> of each contact ends at m g, or its mean is m g.</p>
</html>"));
end AllFormulaContacts;
