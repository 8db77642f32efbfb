within Modelica.Units;
package SI "Quantities in SI units"
  extends Modelica.Icons.Package;

  // Space and time
  type Angle = Real(final quantity="Angle", final unit="rad", displayUnit="deg");
  type SolidAngle = Real(final quantity="SolidAngle", final unit="sr");
  type Length = Real(final quantity="Length", final unit="m");
  type PathLength = Length;
  type Position = Length;
  type Distance = Length(min=0);
  type Breadth = Length(min=0);
  type Height = Length(min=0);
  type Thickness = Length(min=0);
  type Radius = Length(min=0);
  type Diameter = Length(min=0);
  type Area = Real(final quantity="Area", final unit="m2");
  type Volume = Real(final quantity="Volume", final unit="m3");
  type Time = Real(final quantity="Time", final unit="s");
  type Duration = Time;
  type AngularVelocity = Real(final quantity="AngularVelocity", final unit="rad/s");
  type AngularAcceleration = Real(final quantity="AngularAcceleration", final unit="rad/s2");
  type AngularJerk = Real(final quantity="AngularJerk", final unit="rad/s3");
  type Velocity = Real(final quantity="Velocity", final unit="m/s");
  type Acceleration = Real(final quantity="Acceleration", final unit="m/s2");
  type Jerk = Real(final quantity="Jerk", final unit="m/s3");
  type Period = Real(final quantity="Time", final unit="s");
  type Frequency = Real(final quantity="Frequency", final unit="Hz");
  type AngularFrequency = Real(final quantity="AngularFrequency", final unit="rad/s");
  type DampingCoefficient = Real(final quantity="DampingCoefficient", final unit="s-1");

  // Mechanics
  type Mass = Real(quantity="Mass", final unit="kg", min=0);
  type Density = Real(final quantity="Density", final unit="kg/m3", displayUnit="g/cm3", min=0);
  type Momentum = Real(final quantity="Momentum", final unit="kg.m/s");
  type Impulse = Real(final quantity="Impulse", final unit="N.s");
  type AngularMomentum = Real(final quantity="AngularMomentum", final unit="kg.m2/s");
  type AngularImpulse = Real(final quantity="AngularImpulse", final unit="N.m.s");
  type MomentOfInertia = Real(final quantity="MomentOfInertia", final unit="kg.m2");
  type Inertia = MomentOfInertia;
  type Force = Real(final quantity="Force", final unit="N");
  type Weight = Force;
  type Torque = Real(final quantity="Torque", final unit="N.m");
  type MomentOfForce = Torque;
  type TranslationalSpringConstant = Real(final quantity="TranslationalSpringConstant", final unit="N/m");
  type TranslationalDampingConstant = Real(final quantity="TranslationalDampingConstant", final unit="N.s/m");
  type RotationalSpringConstant = Real(final quantity="RotationalSpringConstant", final unit="N.m/rad");
  type RotationalDampingConstant = Real(final quantity="RotationalDampingConstant", final unit="N.m.s/rad");
  type Pressure = Real(final quantity="Pressure", final unit="Pa", displayUnit="bar");
  type AbsolutePressure = Pressure(min=0, nominal=1e5);
  type Stress = Real(final unit="Pa");
  type NormalStress = Stress;
  type ShearStress = Stress;
  type Strain = Real(final quantity="Strain", final unit="1");
  type LinearStrain = Strain;
  type ShearStrain = Strain;
  type PoissonNumber = Real(final quantity="PoissonNumber", final unit="1");
  type ModulusOfElasticity = Stress;
  type ShearModulus = Stress;
  type SecondMomentOfArea = Real(final quantity="SecondMomentOfArea", final unit="m4");
  type CoefficientOfFriction = Real(final quantity="CoefficientOfFriction", final unit="1");
  type Work = Real(final quantity="Work", final unit="J");
  type Energy = Real(final quantity="Energy", final unit="J");
  type PotentialEnergy = Energy;
  type KineticEnergy = Energy;
  type Power = Real(final quantity="Power", final unit="W");
  type Efficiency = Real(final quantity="Efficiency", final unit="1", min=0);
  type DimensionlessRatio = Real(unit="1");
  type PerUnit = Real(unit="1");

  // Heat and electricity, as far as drives need them
  type ThermodynamicTemperature = Real(final quantity="ThermodynamicTemperature", final unit="K", min=0, start=288.15, nominal=300, displayUnit="degC");
  type Temperature = ThermodynamicTemperature;
  type HeatFlowRate = Real(final quantity="Power", final unit="W");
  type ElectricCurrent = Real(final quantity="ElectricCurrent", final unit="A");
  type Current = ElectricCurrent;
  type ElectricPotential = Real(final quantity="ElectricPotential", final unit="V");
  type Voltage = ElectricPotential;
  type Resistance = Real(final quantity="Resistance", final unit="Ohm");
  type Inductance = Real(final quantity="Inductance", final unit="H");
  type ElectricalTorqueConstant = Real(final quantity="ElectricalTorqueConstant", final unit="N.m/A");
  annotation (Documentation(info="<html>
<p>Types for the quantities of mechanics and drives, named and with units after ISO 80000.</p>
</html>"));
end SI;
